#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/sets/contour/contour_graph.h"
#include "planner/sets/contour/set_geometry.h"
#include "render/figures/grasp_diagram.h"

namespace regrasp::render {

/// The two ends of a line segment.
using Segment = std::array<Eigen::Vector2d, 2>;

/// A set of a contour graph unfolded in the plane. It continues across the end of a ring, and is
/// not mirrored at the axis of symmetry.
struct UnfoldedSet {
  std::vector<Outline> pieces;
  std::vector<Segment> border;
  /// Lines at which the set is cut: it continues around the object and would overlap itself.
  std::vector<Segment> cuts;
  std::vector<Segment> diagram;  ///< L-infinity Voronoi diagram of its border
};

/// Unfold the set of a grasp, starting at the grasp, in breadth-first order over the passages
/// between pieces.
///
/// The grasp is at its own coordinates (Phoka 2010, section 4.2.2: in the first period). Pieces do
/// not overlap, and their total area is that of the set.
/// @param upright  index (0 or 1) of the grasp's coordinate that becomes the vertical one.
[[nodiscard]] UnfoldedSet UnfoldSet(contour::SetGeometry& geometry,
                                    const contour::PlacedGrasp& root, int upright);

/// Split the border of a set at the ends of edges. Each part refers to the piece that it bounds.
[[nodiscard]] std::vector<contour::BorderSegment> SplitBorder(const contour::ContourGraph& graph,
                                                              sets::SetIndex set);

/// A grasp of two contacts on the axes of contact space, the horizontal one first. A finger stays
/// on its axis as long as it is in contact.
using AxisGrasp = std::array<plan::FingerContact, 2>;

/// A point of contact space: the rings of its axes and the boundary lengths on them.
struct SpacePoint {
  std::array<contour::RingIndex, 2> rings = {};
  Eigen::Vector2d places = Eigen::Vector2d::Zero();
};

/// A plan entry in contact space.
struct TrackEntry {
  const char* kind = "";           ///< "hold", or the result of StepKind
  AxisGrasp grasp;                 ///< grasp after the entry
  std::vector<AxisGrasp> path;     ///< waypoints of a sliding step
  std::optional<int> shared_axis;  ///< axis of the contact that stays in a switch, 0 or 1
};

/// Number of contacts of the static grasp after a plan entry.
struct StaticGraspSize {
  plan::EntryIndex entry{0};
  int contacts = 0;
  friend bool operator==(const StaticGraspSize&, const StaticGraspSize&) = default;
};

/// Return the first static grasp without exactly two contacts.
[[nodiscard]] std::optional<StaticGraspSize> FindOtherThanTwoContacts(const plan::Plan& plan);

/// Compute the path of a plan through contact space.
///
/// The horizontal axis of the initial grasp belongs to the contact on the edge with the lower
/// index. A placed finger takes the axis of the released one, so that a switch that keeps a contact
/// is parallel to an axis.
/// @param plan  located plan for which FindOtherThanTwoContacts returns nullopt.
[[nodiscard]] std::vector<TrackEntry> TrackPlan(const plan::Plan& plan);

[[nodiscard]] SpacePoint PointOf(const contour::Boundary& boundary, const AxisGrasp& grasp);

}  // namespace regrasp::render
