#pragma once

#include <string>

#include "planner/plan/plan.h"

namespace regrasp::render {

/// The longest of 1, 2 or 5 times a power of ten that is no longer than `limit` (> 0).
[[nodiscard]] double RoundLength(double limit);

/// What happens in an entry of a plan: "hold: fingers 0, 1, 2, 3", "switch: place 4, release 0",
/// "align: move 1, 3".
/// @param entry  0 the hold, k the plan's k-th step.
[[nodiscard]] std::string EntryTitle(const plan::Plan& plan, plan::EntryIndex entry);

/// What a frame shows, in a line: "hold: fingers 0, 1, 2, 3" for entry 0, "step 1/3 · switch:
/// place 4, release 0", "step 2/3 · align: move 1 by 12 mm, 3 by 8 mm along the surface".
/// @param entry  0 the hold, k the plan's k-th step.
[[nodiscard]] std::string FrameCaption(const plan::Plan& plan, plan::EntryIndex entry);

}  // namespace regrasp::render
