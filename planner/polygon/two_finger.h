#pragma once

#include <vector>

#include "planner/polygon/candidates.h"
#include "planner/polygon/contact_range.h"
#include "planner/polygon/filtered_region.h"

namespace regrasp {

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

}  // namespace regrasp
