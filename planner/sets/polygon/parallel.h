#pragma once

#include <optional>
#include <vector>

#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/contact_range.h"
#include "planner/sets/polygon/filtered_region.h"

namespace regrasp::polygon {

/// Parallel grasps of three edges with one centre contact a, the others being b and c.
///
/// Let w_0 and w_1 be the right and left border of the common cone −C(n_a) ∩ C(n_b) ∩ C(n_c), and
/// f_i(x) = cross(w_i, p_x − p_a) for x = b, c: on which side of the common cone drawn at p_a a
/// contact lies. A grasp is parallel unless b and c lie in the same outer region (Phoka 2010,
/// Prop. 3.8), so the set is the open cube of the three parameters without two closed corners,
///
///     L: all f_i(b), f_i(c) >= 0        R: all f_i(b), f_i(c) <= 0,
///
/// a union of six convex polytopes. Every f falls strictly when any of its parameters grows, for w
/// is within θ of n_b and n_c and of −n_a. Hence, with no polytope being built:
/// - the set is empty iff the far end of the cube, where all parameters are 1, is in L or the near
///   end, all 0, in R;
/// - it is connected: a slice at one u_a is a square without two corner rectangles that do not
///   meet, and the slices that are not empty form an interval;
/// - its projections on one and two parameters are those below;
/// - a connected set G of grasps has none in common with it iff G lies in L or in R, as L and R do
///   not meet, and that is seen in the projections of G on (a, b) and (a, c).
///
/// One triple has several centres only where θ ≥ 45°; their sets are one where they share grasps.
struct ParallelComponent {
  std::vector<int> centres;  ///< positions among the three edges, ascending
};

/// The components of the parallel grasps of three edges. Inside an IntervalScope, as all here.
[[nodiscard]] std::vector<ParallelComponent> FindParallelSets(const EdgeTable& edges,
                                                              const ParallelCandidate& candidate);

/// The contacts on the k-th edge. `edges` must outlive the result, as in the next.
[[nodiscard]] FilteredRange ParallelContactRange(const EdgeTable& edges, const EdgeTriple& triple,
                                                 const ParallelComponent& component, int k);

/// The pairs of contacts on the k-th and l-th edge (k < l), as a union of convex regions of [0,
/// 1]².
[[nodiscard]] std::vector<FilteredRegion> ParallelContactPairs(const EdgeTable& edges,
                                                               const EdgeTriple& triple,
                                                               const ParallelComponent& component,
                                                               int k, int l);

/// The projections of a connected set of grasps of three edges on two of their parameters:
/// [k][l], k < l. Several regions stand for their union.
using PairProjections = std::array<std::array<std::vector<FilteredRegion>, 3>, 3>;

/// True iff a connected set of grasps of the same three edges, given by its projections, has grasps
/// in common with the parallel ones of this centre.
[[nodiscard]] bool SharesGrasps(const EdgeTable& edges, const EdgeTriple& triple, int centre,
                                const PairProjections& other);

}  // namespace regrasp::polygon
