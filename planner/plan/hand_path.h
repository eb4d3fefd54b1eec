#pragma once

#include <vector>

#include "planner/plan/plan.h"

namespace regrasp::plan {

/// The state between two that follow each other on a path (HandPath).
/// @param share  0: `from`, 1: `to`.
[[nodiscard]] HandState StateBetween(const HandState& from, const HandState& to, double share);

/// All paths of a step as a hand does it, in their order; none where the plan does not say.
[[nodiscard]] std::vector<const HandPath*> PathsOf(const Step& step);

}  // namespace regrasp::plan
