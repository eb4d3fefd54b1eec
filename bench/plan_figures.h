#pragma once

#include "planner/plan/plan.h"

namespace regrasp {

/// Return the number of sliding steps.
[[nodiscard]] int CountAligns(const plan::Plan& plan);

/// Return the total travel of all fingers, in the object's unit of length.
/// A sliding step contributes the distances between its waypoints. A finger switch contributes, for
/// each placed contact, the straight distance from the nearest released one, and 0 if none is
/// released.
///
/// Laws: independent of the fingers' numbers and of rigid motion; scales with the unit of length.
/// @pre Every waypoint of a sliding step has the fingers of the first.
[[nodiscard]] double TravelOf(const plan::Plan& plan);

}  // namespace regrasp
