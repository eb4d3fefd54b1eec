#pragma once

#include <optional>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Claimed and actual contact regions of a finger switch between 2-finger grasps.
struct SwitchRegion {
  /// Smaller half-width of the contact regions of the grasps before and after
  /// (planner/plan/contact_region.h), in the object's unit of length.
  double half_width = 0;
  /// Smallest `region` of the placed contacts, if any has one.
  std::optional<double> claimed = std::nullopt;
  /// Whether nothing is claimed, or no more than the actual region to within kPointTolerance · D.
  bool holds = true;
};

/// Measure the regions of a finger switch.
/// @param before  grasp before the switch, located like the switch (ProjectPlan).
/// @param friction_angle  friction angle θ, radians, in (0, π/2).
/// @returns the regions; nullopt if the grasp before or after does not have two contacts.
[[nodiscard]] std::optional<SwitchRegion> MeasureSwitchRegion(const object::Polygon& polygon,
                                                              const FingerGrasp& before,
                                                              const Switch& step,
                                                              double friction_angle);

/// Compute the half-width of the independent contact region of a 2-finger grasp on a polygon.
/// Both contacts may move independently by up to the half-width h along the boundary, across its
/// vertices (Phoka 2010, section 4.6.2). The grasp then stays force closure of the same kind:
/// pressing inwards, or outwards in a notch or hole (stretching). The result is the largest such h.
///
/// An interval [s − h, s + h] of the boundary length is cut at the vertices. For two pieces, one on
/// each of two edges, the force-closure grasps of one kind are a convex set of the two lengths:
/// p_b − p_a is linear in them, and must be in a convex cone. The rectangle of the pieces is
/// therefore inside the set iff its four corners are. A contact at a vertex must satisfy the
/// condition with the normals of both edges. The condition is monotone in h, hence a bisection.
///
/// Laws: independent of the order of the contacts and of rigid motion; proportional to scale. Never
/// decreases with friction. Every grasp of the region is force closure. Beyond it by
/// kRegionAccuracy · D some grasp is not, or the limit is reached.
/// @param friction_angle  friction angle θ, radians, in (0, π/2).
/// @param limit       upper limit of the search, in the polygon's unit of length.
/// @returns a lower bound within kRegionAccuracy · D; 0 if the grasp is not force closure.
/// @throws std::invalid_argument  if there are not two contacts, a contact has no edge, or the
///     limit is negative or not finite; as IsForceClosure.
[[nodiscard]] double MeasureContactRegion(const object::Polygon& polygon,
                                          const grasp::Grasp& two_contacts, double friction_angle,
                                          double limit);

/// Accuracy of half-widths over the diameter: a tenth of the distance within which two points count
/// as equal.
inline constexpr double kRegionAccuracy = 1e-7;

}  // namespace regrasp::plan
