#pragma once

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/index.h"
#include "planner/planning/spanning.h"  // IWYU pragma: export

namespace regrasp::polygon {

/// The kinds of force-closure grasps of a polygon (Phoka 2010, section 3.2).
enum class GraspType {
  kConcurrent,  ///< three contacts whose cones see one focus point, normals φ-positively spanning
  kTwoFinger,   ///< two contacts, the line through them inside both cones
  kParallel,    ///< three contacts with parallel forces, the middle one opposing the others
};

/// A vertex of the switching graph: a connected component of the grasps of one type on distinct
/// edges. Contacts are a + u (b − a), 0 < u < 1, on an edge from a to b, material on the left.
///
/// A set is a union of convex parts, each given by linear inequalities once `part` is fixed:
/// - concurrent: bit k of a part is set iff the focus point lies on the outer side of the line of
///   edges[k]. A part holds the focus points x and contacts p_k with ±(x − p_k) in the cone of
///   half-angle φ about the inward normal (+ on the inner side);
/// - two-finger: part 0 squeezes, p_1 − p_0 in the cone at p_0 and p_0 − p_1 in the one at p_1;
///   part 1 stretches, the mirror image;
/// - parallel: a part is the position in `edges` of the centre contact, whose force opposes the
///   other two (more than one only where θ ≥ 45°). It is a union of convex polytopes itself
///   (planner/sets/polygon/parallel.h), always connected.
struct GraspSet {
  GraspType type = GraspType::kConcurrent;
  std::vector<FaceIndex> edges;  ///< ascending; three, or two of a two-finger set
  double tangent = 0;      ///< tan φ of a concurrent set, tan θ of the others; exact as it stands
  std::vector<int> parts;  ///< ascending
};

/// Whether a part of a concurrent set has its focus points on the outer side of the k-th edge.
[[nodiscard]] inline bool IsOuter(int part, int k) { return (part >> k & 1) != 0; }

/// The positions of the contacts of a parallel grasp that are not its centre, ascending.
[[nodiscard]] inline std::array<int, 2> OuterOf(int centre) {
  return {centre == 0 ? 1 : 0, centre == 2 ? 1 : 2};
}

inline constexpr int kGraspTypes = 3;

/// How many of a type, as tables 3.1 and 3.2 of Phoka 2010 count them.
struct GraspTypeCounts {
  std::int64_t candidates = 0;    ///< combinations of edges that pass the test on normals alone
  std::int64_t combinations = 0;  ///< those with a set whose interior is not empty
  std::int64_t vertices = 0;      ///< connected components of these interiors
  std::int64_t components = 0;    ///< of the graph, were there only this type
};

/// Edges of a polygon that two sets have in common, by their positions in the first and in the
/// second.
using CommonEdges = boost::container::static_vector<std::pair<int, int>, 3>;
/// @param a, b  ascending.
[[nodiscard]] CommonEdges FindCommonEdges(std::span<const FaceIndex> a,
                                          std::span<const FaceIndex> b);

}  // namespace regrasp::polygon
