#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp {

/// Bounds on a quality; lower <= Q <= upper.
struct QualityBounds {
  double lower = 0;
  double upper = 0;
};

/// The quality ε of Ferrari and Canny 1992 (the L1 metric): the radius of the largest ball about
/// the origin inside the wrenches that contact forces with Σ n_i·f_i ≤ 1 can apply, torques over
/// R. 0 where the grasp is not force closure.
///
/// Laws: independent of order, rigid motion and unit of length; monotone in half_angle and in the
/// set of contacts.
/// @param relative_gap  the bounds are refined until upper − lower ≤ relative_gap · upper.
[[nodiscard]] QualityBounds ComputeQuality(std::span<const Contact> contacts,
                                           const WrenchFrame& frame, double half_angle,
                                           double relative_gap = 0.01);

/// True iff ε ≥ threshold is certain; stops as soon as it is decided, so it is far cheaper than
/// ComputeQuality for grasps that are clearly better or worse.
[[nodiscard]] bool QualityAtLeast(std::span<const Contact> contacts, const WrenchFrame& frame,
                                  double half_angle, double threshold);

}  // namespace regrasp
