#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/quality.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Smallest relative gap of BoundQuality. GrowingHull moves the hull's points by 1e-7 of their
/// length, and a gap must be much larger.
inline constexpr double kLeastRelativeGap = 1e-5;

/// Bound the grasp quality ε (quality.h) about a hundred times faster than ComputeQuality.
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
