#pragma once

#include <filesystem>
#include <vector>

#include "page/report_page.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frame.h"
#include "sim/report.h"

namespace regrasp {

/// Removes from `folder` the pictures of an earlier run (000_hold.png, 001_switch.png, …), so that
/// it never mixes runs. Other files stay.
/// @throws EnvironmentError  one of them cannot be removed.
void RemoveFrames(const std::filesystem::path& folder);

/// Draws a frame of every replayed step into `folder` and names it in the report. The frame of a
/// step that failed in the replay shows what the replay saw at its end.
/// @returns the same pictures, smaller, one for each entry of the report.
/// @throws EnvironmentError  no rendering context, or the folder cannot be written.
[[nodiscard]] std::vector<PagePicture> WriteFrames(const Object& object, const Plan& plan,
                                                   const FrameOptions& options,
                                                   const std::filesystem::path& folder,
                                                   Report& report);

}  // namespace regrasp
