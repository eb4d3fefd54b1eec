#pragma once

#include "planner/plan/plan.h"

namespace regrasp {

/// Aligns among the steps.
[[nodiscard]] int CountAligns(const plan::Plan& plan);

/// The travel of all fingers together, in the object's unit of length: from waypoint to waypoint in
/// an align; in a switch for each contact that is placed straight from the nearest one that is
/// released, and none where nothing is released.
///
/// Laws: independent of the fingers' numbers and of rigid motion; grows with the unit of length.
/// @pre every waypoint of an align has the fingers of the first.
[[nodiscard]] double TravelOf(const plan::Plan& plan);

}  // namespace regrasp
