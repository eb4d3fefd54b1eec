#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/quality.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Smallest relative gap of BoundQuality: the hull's points are moved by 1e-7 of their length,
/// which a gap must exceed by far.
inline constexpr double kLeastRelativeGap = 1e-5;

/// Bound the grasp quality ε (quality.h) about a hundred times faster than ComputeQuality.
///
/// One hull of wrenches grows at its facet nearest to the origin (GrowingHull). The distance of
/// that facet bounds ε from below. The support of the whole wrench set along the facet's normal
/// bounds it from above, and its point extends the hull. The friction cones stay circular: no
/// pyramid replaces them. If rounding breaks the hull, ComputeQuality answers. bench/README.md has
/// the times.
///
/// The bounds differ from those of ComputeQuality within the gap. Plan files depend on the latter.
///
/// Laws: as for ComputeQuality.
/// @param half_angle    friction angle in radians, in (0, π/2).
/// @param relative_gap  upper − lower over upper, at least kLeastRelativeGap. The bounds are
/// farther
///                      apart, up to kQualityGap or after kMostQualityFacets, as in ComputeQuality.
/// @throws std::invalid_argument  if the gap is smaller, or as TestForceClosure.
[[nodiscard]] QualityBounds BoundQuality(std::span<const Contact> contacts,
                                         const object::WrenchFrame& frame, double half_angle,
                                         double relative_gap = 0.01);

/// Bound the quality as BoundQuality, but return none if rounding breaks the hull.
/// @param contacts  force closure at the half-angle.
[[nodiscard]] std::optional<QualityBounds> BoundQualityByHull(std::span<const Contact> contacts,
                                                              const object::WrenchFrame& frame,
                                                              double half_angle,
                                                              double relative_gap = 0.01);

}  // namespace regrasp::grasp
