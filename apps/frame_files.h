#pragma once

#include <filesystem>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frame.h"
#include "sim/report.h"

namespace regrasp {

/// Removes from `folder` the frames of an earlier run (000_hold.png, 001_switch.png, …), so that it
/// never mixes runs. Other files stay.
/// @throws EnvironmentError  one of them cannot be removed.
void RemoveFrames(const std::filesystem::path& folder);

/// Draws a frame of every replayed step into `folder` and names it in the report. The frame of a
/// step that failed in the replay shows what the replay saw at its end.
/// @throws EnvironmentError  no rendering context, or the folder cannot be written.
void WriteFrames(const Object& object, const Plan& plan, const FrameOptions& options,
                 const std::filesystem::path& folder, Report& report);

}  // namespace regrasp
