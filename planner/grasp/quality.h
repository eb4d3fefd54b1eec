#pragma once

#include <cstdint>
#include <optional>
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

/// Smallest relative gap of BoundQuality. GrowingHull moves the hull's points by 1e-7 of their
/// length, and a gap must be much larger.
inline constexpr double kLeastRelativeGap = 1e-5;

/// Bound the grasp quality ε (ComputeQuality) about a hundred times faster than ComputeQuality.
///
/// One hull of wrenches grows at its facet nearest to the origin (GrowingHull). The distance of
/// that facet is a lower bound on ε. The support of the whole wrench set along the facet's normal
/// is an upper bound, and its point extends the hull. The friction cones are circular, not
/// pyramids. If rounding breaks the hull, the bounds are those of ComputeQuality. bench/README.md
/// lists the times.
///
/// The bounds differ from those of ComputeQuality within the gap. Plan files depend on the latter.
///
/// Laws: as for ComputeQuality.
/// @param friction_angle    friction angle in radians, in (0, π/2).
/// @param relative_gap  largest (upper − lower) / upper, at least kLeastRelativeGap. As in
///     ComputeQuality, the bounds may be farther apart: up to kQualityGap, or after
///     kMostQualityFacets.
/// @throws std::invalid_argument  if the gap is smaller, or as TestForceClosure.
[[nodiscard]] QualityBounds BoundQuality(std::span<const Contact> contacts,
                                         const object::WrenchFrame& frame, double friction_angle,
                                         double relative_gap = 0.01);

/// Bound the quality as BoundQuality, but return nullopt if rounding breaks the hull.
/// @param contacts  contacts that are force closure at the friction angle.
[[nodiscard]] std::optional<QualityBounds> BoundQualityByHull(std::span<const Contact> contacts,
                                                              const object::WrenchFrame& frame,
                                                              double friction_angle,
                                                              double relative_gap = 0.01);

}  // namespace regrasp::grasp
