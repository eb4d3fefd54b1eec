#pragma once

#include <string>

#include "planner/plan/plan.h"

namespace regrasp::render {

/// Return the longest length of the form 1, 2 or 5 times a power of ten up to `limit` (> 0).
[[nodiscard]] double RoundLength(double limit);

/// Return a title of a plan entry, for example "hold: fingers 0, 1, 2, 3", "switch: place 4,
/// release 0" or "align: move 1, 3".
/// @param entry  index of the entry: 0 the initial grasp, k the k-th step.
[[nodiscard]] std::string EntryTitle(const plan::Plan& plan, plan::EntryIndex entry);

/// Return the caption of a frame on one line.
///
/// Examples: "hold: fingers 0, 1, 2, 3" for entry 0, "step 1/3 · switch: place 4, release 0", "step
/// 2/3 · align: move 1 by 12 mm, 3 by 8 mm along the surface".
/// @param entry  index of the entry: 0 the initial grasp, k the k-th step.
[[nodiscard]] std::string FrameCaption(const plan::Plan& plan, plan::EntryIndex entry);

}  // namespace regrasp::render
