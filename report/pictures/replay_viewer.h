#pragma once

#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/viewer/viewer_scene.h"
#include "report/pictures/replay_timeline.h"
#include "report/pictures/report_pictures.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the interactive 3-D replay of a report.
/// It has all entries up to the failed one, and ends at the failing instant with the marks of its
/// frame.
/// @param options  options of the frames; hand, body and view direction are used.
/// @param samples  recorded states of a replay by a hand, ascending in entry and time; may be
/// empty.
[[nodiscard]] render::ViewerScene MakeViewerScene(const object::Object& object,
                                                  const plan::Plan& plan,
                                                  const DrawingOptions& options,
                                                  const std::vector<HandSample>& samples,
                                                  const Report& report);

}  // namespace regrasp::report
