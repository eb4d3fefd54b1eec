#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/sets/contour/boundary.h"

namespace regrasp::render {

/// A grasp of two contacts on the axes of contact space: the horizontal one first. Which finger is
/// on which axis lasts while it holds.
using AxisGrasp = std::array<plan::FingerContact, 2>;

/// A point of contact space: the rings that its axes belong to and the places on them.
struct SpacePoint {
  std::array<contour::RingIndex, 2> rings = {};
  Eigen::Vector2d places = Eigen::Vector2d::Zero();
};

/// What one entry of a plan is in contact space.
struct TrackEntry {
  const char* kind = "";           ///< "hold", or as StepKind
  AxisGrasp grasp;                 ///< after it
  std::vector<AxisGrasp> path;     ///< the waypoints of an align
  std::optional<int> shared_axis;  ///< of a switch: where the contact is that stays, 0 or 1
};

/// A grasp at rest of a plan, that after an entry.
struct RestSize {
  plan::EntryIndex entry{0};
  int contacts = 0;
  friend bool operator==(const RestSize&, const RestSize&) = default;
};

/// The first grasp at rest that has not two contacts.
[[nodiscard]] std::optional<RestSize> FindOtherThanTwoFingers(const plan::Plan& plan);

/// Follows a plan through contact space. The initial grasp has its contact on the lower edge on the
/// horizontal axis; a finger that is placed takes the axis of the one that is released, so that a
/// switch that keeps a contact moves along one axis.
/// @param plan  located; FindOtherThanTwoFingers finds none.
[[nodiscard]] std::vector<TrackEntry> TrackPlan(const plan::Plan& plan);

[[nodiscard]] SpacePoint PointOf(const contour::Boundary& boundary, const AxisGrasp& grasp);

}  // namespace regrasp::render
