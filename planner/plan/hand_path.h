#pragma once

#include "planner/plan/plan.h"

namespace regrasp::plan {

/// The state between two that follow each other on a path (HandPath).
/// @param share  0: `from`, 1: `to`.
[[nodiscard]] HandState StateBetween(const HandState& from, const HandState& to, double share);

}  // namespace regrasp::plan
