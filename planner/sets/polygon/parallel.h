#pragma once

#include <optional>
#include <vector>

#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/convex_region.h"

namespace regrasp::polygon {

/// Connected component of the parallel grasps of three edges.
///
/// Let a be the centre contact, and b and c the two others. Let w_0 and w_1 be the right and left
/// border of the common cone −C(n_a) ∩ C(n_b) ∩ C(n_c). For x = b, c, f_i(x) = cross(w_i, p_x −
/// p_a) states on which side of the common cone at p_a the contact is. A grasp is parallel unless b
/// and c are in the same outer region (Phoka 2010, Prop. 3.8). The set is therefore the open cube
/// of the three parameters without two closed corners,
///
///     L: all f_i(b), f_i(c) >= 0        R: all f_i(b), f_i(c) <= 0,
///
/// which is a union of six convex polytopes. Every f decreases strictly in each of its parameters,
/// because w is within θ of n_b, n_c and −n_a. Therefore no polytope must be built:
/// - The set is empty iff the far end of the cube, all parameters 1, is in L or the near end, all
///   0, in R.
/// - It is connected: a slice at one u_a is a square without two disjoint corner rectangles, and
///   the non-empty slices form an interval.
/// - Its projections on one and two parameters are those below.
/// - A connected set G of grasps is disjoint from it iff G is in L or in R, because L and R are
///   disjoint. The projections of G on (a, b) and (a, c) decide this.
///
/// A triple can have several centres only for θ ≥ 45°. Their sets are one component if they share
/// grasps.
struct ParallelComponent {
  std::vector<int> centres;  ///< positions among the three edges, ascending
};

/// Find the components of the parallel grasps of three edges. Call all functions here in an
/// IntervalScope.
[[nodiscard]] std::vector<ParallelComponent> FindParallelSets(const EdgeTable& edges,
                                                              const ParallelCandidate& candidate);

/// Return the contacts on the k-th edge. `edges` must outlive the result, also of the next
/// function.
[[nodiscard]] FilteredRange ParallelContactRange(const EdgeTable& edges, const EdgeTriple& triple,
                                                 const ParallelComponent& component, int k);

/// Return the pairs of contacts on the k-th and l-th edge (k < l), as a union of convex regions of
/// [0, 1]².
[[nodiscard]] std::vector<FilteredRegion> ParallelContactPairs(const EdgeTable& edges,
                                                               const EdgeTriple& triple,
                                                               const ParallelComponent& component,
                                                               int k, int l);

/// Projections of a connected set of grasps of three edges on two of their parameters: [k][l], k <
/// l. A projection is the union of its regions.
using PairProjections = std::array<std::array<std::vector<FilteredRegion>, 3>, 3>;

/// Return whether a connected set of grasps shares grasps with the parallel ones of a centre.
/// @param other  projections of the connected set, which is on the same three edges.
[[nodiscard]] bool SharesGrasps(const EdgeTable& edges, const EdgeTriple& triple, int centre,
                                const PairProjections& other);

}  // namespace regrasp::polygon
