#pragma once

#include <array>
#include <vector>

#include "planner/base/in_blocks.h"
#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/contact_range.h"
#include "planner/sets/polygon/filtered_region.h"
#include "planner/sets/polygon/parallel.h"

namespace regrasp::polygon {

/// The grasps on two edges, in their contact parameters; it may be empty.
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

/// The parameters of the k-th contact in such a region, which is not empty.
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

/// The 2-finger grasps of a pair of edges that squeeze or that stretch the object.
struct TwoFingerPart {
  bool stretching;
  FilteredRegion region;  ///< in the parameters of the two edges
};

/// The graspable sets of a pair: with v = p_b − p_a, squeezing is v ∈ C(n_a) ∩ −C(n_b), stretching
/// −v. Each is a convex polygon in the two contact parameters, and they never have a grasp in
/// common: each is a component of its own. Seeing both contacts in the double-sided cones from one
/// point, as Phoka 2010, section 3.3.1.2, has it, is not enough, since both may lie on one side.
/// Inside an IntervalScope; `edges` must outlive the result.
[[nodiscard]] std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                                           const TwoFingerCandidate& candidate);

/// The contacts on the k-th edge. `part` must outlive the result.
[[nodiscard]] FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k);

/// A set of grasps and the edges that it was found on.
template <class Candidate, class Component>
struct PolygonVertex {
  Candidate candidate;
  Component component;
};

/// The sets of grasps that are the vertices of a polygon's switching graph, of each type by their
/// edges, as exact predicates see them.
struct PolygonVertices {
  std::vector<PolygonVertex<ConcurrentCandidate, FocusComponent>> concurrent;
  std::vector<PolygonVertex<TwoFingerCandidate, TwoFingerPart>> two_finger;
  std::vector<PolygonVertex<ParallelCandidate, ParallelComponent>> parallel;
  std::array<GraspTypeCounts, kGraspTypes> counts;  ///< by GraspType, without components
};

/// Inside an IntervalScope. @param edges  outlives the result. @param tell  told how much is done.
/// @throws TimeUp  the deadline came.
[[nodiscard]] PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                                           const Deadline& deadline = {}, const Tell& tell = {});

}  // namespace regrasp::polygon
