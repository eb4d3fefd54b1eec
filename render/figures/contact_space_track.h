#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/sets/contour/boundary.h"
#include "planner/sets/contour/set_geometry.h"
#include "render/figures/grasp_diagram.h"

namespace regrasp::render {

/// Two ends of a straight line.
using Segment = std::array<Eigen::Vector2d, 2>;

/// A set of a contour's graph laid out in the plane, free of the frame: across the end of a ring it
/// goes on, and across the axis of symmetry it is not mirrored.
struct UnfoldedSet {
  std::vector<Outline> pieces;
  std::vector<Segment> border;
  /// Where the set goes on but the plane has no space: it comes back to itself around a ring, once
  /// around the object, and is cut there.
  std::vector<Segment> cuts;
  std::vector<Segment> diagram;  ///< the L-infinity Voronoi diagram of its border
};

/// Unfolds the set of a grasp from there, piece by piece, the nearest first by passages.
///
/// Laws: the grasp lies at its own places (Phoka 2010, section 4.2.2: in the first period); pieces
/// don't overlap and have the area that the set has.
/// @param upright  which of the grasp's two places the second coordinate is, 0 or 1.
[[nodiscard]] UnfoldedSet UnfoldSet(contour::SetGeometry& geometry,
                                    const contour::PlacedGrasp& root, int upright);

/// The parts of a set's border, none longer than an edge, each with the piece that it bounds.
[[nodiscard]] std::vector<contour::BorderSegment> SplitBorder(const contour::ContourGraph& graph,
                                                              sets::SetIndex set);

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
