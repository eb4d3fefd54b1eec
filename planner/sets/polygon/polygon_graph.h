#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/in_blocks.h"
#include "planner/object/polygon.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/convex_region.h"
#include "planner/sets/polygon/parallel.h"
#include "planner/sets/polygon/set_cells.h"
#include "planner/sets/set_graph.h"

namespace regrasp::polygon {

/// Switching graph of a polygon (Phoka 2010, chapter III).
///
/// Vertices are GraspSets; an edge is a finger switch between two of them:
/// - concurrent–concurrent: exactly two edges of the polygon are common, and the focus cells
///   overlap.
/// - two-finger–two-finger: always.
/// - two-finger–other: an edge is common, and the projections on its contact parameter overlap.
/// - parallel–parallel: exactly two edges are common, and the projections on their parameters
///   overlap.
/// - concurrent–parallel, only with Spanning::kAdaptive: same as parallel–parallel; or all three
///   edges are common and the sets share grasps, which needs no switch.
///
/// Sets that only touch do not overlap. Every decision is exact for the doubles of the polygon's
/// coordinates and of each set's tangent: interval arithmetic first, then exact numbers.
///
/// Laws: the counts do not change if the polygon is scaled by a power of two, mirrored or rotated
/// by 90°, or if its edges are numbered from another vertex. With Spanning::kAdaptive, more
/// friction removes no grasp.
class PolygonGraph final : public sets::SetGraph {
 public:
  /// Build the graph; `tell` receives the progress.
  /// @param friction_angle  friction angle θ, rad.
  /// @throws std::invalid_argument  if θ is not in (0, π/2).
  /// @throws TimeUp  if the deadline is reached.
  PolygonGraph(const object::Polygon& polygon, double friction_angle, planning::Spanning spanning,
               const Deadline& deadline = {}, const Tell& tell = {});

  /// Sets in the order concurrent, two-finger, parallel; within a type sorted by edges. All
  /// two-finger sets are connected with each other.
  [[nodiscard]] const std::vector<GraspSet>& sets() const { return sets_; }
  [[nodiscard]] const GraspTypeCounts& counts(GraspType type) const {
    return counts_[static_cast<int>(type)];
  }
  /// Number of unordered pairs of connected vertices of two types.
  [[nodiscard]] std::int64_t edge_count(GraspType a, GraspType b) const;
  /// Return the vertices of any type on exactly these edges (ascending).
  [[nodiscard]] std::vector<sets::SetIndex> SetsOn(const std::vector<FaceIndex>& edges) const;

 private:
  [[nodiscard]] std::int64_t CountComponents(GraspType type) const;

  std::vector<GraspSet> sets_;
  std::array<GraspTypeCounts, kGraspTypes> counts_;
};

/// Return the grasps on two edges as a region of their contact parameters, which may be empty.
template <class NT>
ConvexRegion<NT> MakeTwoFingerRegion(const EdgeFrame<NT>& a, const EdgeFrame<NT>& b,
                                     bool stretching) {
  const NT sign(stretching ? -1 : 1);
  // v = between + u_b · b.along − u_a · a.along must be on the left of both right borders and on
  // the right of both left borders.
  const Vector2<NT> between = b.a - a.a;
  auto region = ConvexRegion<NT>::UnitSquare();
  const auto clip_left_of = [&](const Vector2<NT>& direction) {
    region.Clip({-sign * Cross(direction, a.along), sign * Cross(direction, b.along),
                 sign * Cross(direction, between)});
  };
  clip_left_of(a.right);
  clip_left_of(-a.left);
  clip_left_of(-b.right);
  clip_left_of(b.left);
  return region;
}

/// Return the parameters of the k-th contact in such a region, which must not be empty.
template <class NT>
ContactRange<NT> TwoFingerRange(const ConvexRegion<NT>& region, int k) {
  const auto parameter = [&](const HomogeneousPoint<NT>& p) {
    return Ratio<NT>::Make(k == 0 ? p.x : p.y, p.w);
  };
  Ratio<NT> low = parameter(region.sides().front().from);
  Ratio<NT> high = low;
  for (const auto& side : region.sides()) {
    low = Smaller(low, parameter(side.from));
    high = Larger(high, parameter(side.from));
  }
  return {low, high};
}

/// 2-finger grasps of a pair of edges, either from outside or stretching from inside.
struct TwoFingerPart {
  bool stretching;
  FilteredRegion region;  ///< region of the parameters of the two edges
};

/// Find the graspable sets of a pair of edges.
///
/// With v = p_b − p_a, a grasp from outside has v ∈ C(n_a) ∩ −C(n_b), a stretching one −v. Each set
/// is a convex polygon in the two contact parameters. The two sets are disjoint, so each is a
/// component. The condition of Phoka 2010, section 3.3.1.2, that one point sees both contacts in
/// the double-sided cones, is not sufficient: both contacts may be on the same side of the point.
/// Call it in an IntervalScope; `edges` must outlive the result.
[[nodiscard]] std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                                           const TwoFingerCandidate& candidate);

/// Return the contacts on the k-th edge. `part` must outlive the result.
[[nodiscard]] FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k);

/// A set of grasps with the edges on which it was found.
template <class Candidate, class Component>
struct PolygonVertex {
  Candidate candidate;
  Component component;
};

/// Grasp sets that are the vertices of a polygon's switching graph, in the form that exact
/// predicates require; of each type sorted by edges.
struct PolygonVertices {
  std::vector<PolygonVertex<ConcurrentCandidate, FocusComponent>> concurrent;
  std::vector<PolygonVertex<TwoFingerCandidate, TwoFingerPart>> two_finger;
  std::vector<PolygonVertex<ParallelCandidate, ParallelComponent>> parallel;
  std::array<GraspTypeCounts, kGraspTypes> counts;  ///< counts by GraspType, without `components`
};

/// Find the vertices of the switching graph; `tell` receives the progress.
/// Call it in an IntervalScope.
/// @param edges  must outlive the result.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                                           const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::polygon
