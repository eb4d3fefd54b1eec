#pragma once

#include <filesystem>
#include <vector>

#include "apps/page/report_page.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frame.h"
#include "render/replay_animation.h"
#include "sim/report.h"

namespace regrasp {

/// Removes from `folder` the pictures of an earlier run (000_hold.png, 001_switch.png, …, the
/// contact sheet and the animation), so that it never mixes runs. Other files stay.
/// @throws EnvironmentError  one of them cannot be removed.
void RemoveFrames(const std::filesystem::path& folder);

/// Draws a frame of every replayed step into `folder` and names it in the report, and all of them,
/// small, into the contact sheet overview.png. The frame of a step that failed in the replay shows
/// what the replay saw at its end.
/// @returns the same pictures, smaller, one for each entry of the report.
/// @throws EnvironmentError  no rendering context, or the folder cannot be written.
[[nodiscard]] std::vector<PagePicture> WriteFrames(const Object& object, const Plan& plan,
                                                   const FrameOptions& options,
                                                   const std::filesystem::path& folder,
                                                   Report& report);

/// Writes what was replayed as the moving picture replay.webp into `folder`; nothing where nothing
/// was replayed.
/// @param samples  states during the replay, ascending in time.
/// @throws EnvironmentError  as WriteFrames.
void WriteAnimation(const Object& object, const Plan& plan, const std::vector<Snapshot>& samples,
                    AnimationOptions options, const std::filesystem::path& folder,
                    const Report& report);

}  // namespace regrasp
