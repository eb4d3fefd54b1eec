#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Bounds on a quality Q; lower <= Q <= upper.
struct QualityBounds {
  double lower = 0;
  double upper = 0;
  /// Number of facets of all computed convex hulls, a measure of work.
  std::int64_t facets = 0;
};

/// Format a quality for messages.
/// The lower bound if both are within 2 % of each other, otherwise "at least …, at most …".
/// @param digits  number of significant digits.
[[nodiscard]] std::string QualityText(const QualityBounds& quality, int digits = 4);

/// Gap below which bounds are not refined: a hundredth of the smallest disturbance size in use.
inline constexpr double kQualityGap = 1e-6;

/// Number of facets after which no further hull is computed, which takes a few seconds. Counted
/// instead of timed, so that the same grasp has the same bounds on every machine.
inline constexpr std::int64_t kMostQualityFacets = 300'000;

/// Compute the grasp quality ε of Ferrari and Canny 1992 (the L1 metric).
/// It is the radius of the largest ball about the origin inside the wrenches that contact forces
/// with Σ n_i·f_i ≤ 1 can apply, with torques over R. 0 if the grasp is not force closure.
///
/// Laws: independent of order, rigid motion and unit of length; monotone in friction_angle and in
/// the set of contacts.
/// @param friction_angle  friction angle in radians, in (0, π/2).
/// @param relative_gap  gap of the bounds: they are refined until upper − lower ≤ relative_gap ·
///     upper, or kQualityGap. They are farther apart if more than kMostQualityFacets would be
///     necessary, or because of rounding.
[[nodiscard]] QualityBounds ComputeQuality(std::span<const Contact> contacts,
                                           const object::WrenchFrame& frame, double friction_angle,
                                           double relative_gap = 0.01);

/// Return whether ε ≥ threshold is certain after at most kMostQualityFacets.
/// Stops when it is decided, so it is much cheaper than ComputeQuality for grasps that are clearly
/// better or worse.
[[nodiscard]] bool QualityAtLeast(std::span<const Contact> contacts,
                                  const object::WrenchFrame& frame, double friction_angle,
                                  double threshold);

}  // namespace regrasp::grasp
