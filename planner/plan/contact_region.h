#pragma once

#include <optional>

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// What is claimed and what is true of the contact regions of a switch between 2-finger grasps.
struct SwitchRegion {
  /// The smaller one of the contact regions of the grasps before and after
  /// (planner/plan/contact_region.h), the object's unit of length.
  double half_width = 0;
  /// The smallest `region` of the placed contacts, if one has it.
  std::optional<double> claimed = std::nullopt;
  /// Nothing is claimed, or no more than is true, to within kPointTolerance · D.
  bool holds = true;
};

/// Measures the regions of a switch; nullopt where the grasp before or after is not of two
/// contacts.
/// @param before  the grasp that holds before the switch, located like the switch (LocatePlan).
/// @param half_angle  θ, radians, in (0, π/2).
[[nodiscard]] std::optional<SwitchRegion> MeasureSwitchRegion(const object::Polygon& polygon,
                                                              const FingerGrasp& before,
                                                              const Switch& step,
                                                              double half_angle);

/// The half-width of the independent contact region of a grasp of two contacts on a polygon's
/// boundary (Phoka 2010, section 4.6.2): the largest h for which both contacts may be anywhere
/// within h of where they are, each for itself, measured along the boundary across its vertices,
/// and the grasp is force closure of the same kind (squeezing or stretching).
///
/// An interval [s − h, s + h] of the boundary length is cut at the vertices. For two pieces, one on
/// each of two edges, the force-closure grasps of one kind are a convex set of the two lengths
/// (p_b − p_a lies in a convex cone and is linear in them), so the rectangle of the pieces is
/// inside the set iff its four corners are. A contact at a vertex counts with the normals of both
/// edges. What holds for h holds for less, hence a bisection.
///
/// Laws: independent of the order of the contacts and of rigid motion, proportional to scale; never
/// smaller with more friction; every grasp of the region is force closure, and beyond it by
/// kRegionAccuracy · D one is not, or the limit is reached.
/// @param half_angle  θ, radians, in (0, π/2).
/// @param limit       no more than this is looked for, the polygon's unit of length.
/// @returns a lower bound within kRegionAccuracy · D; 0 where the grasp is not force closure.
/// @throws std::invalid_argument  not two contacts, one without its edge; a limit that is negative
///                                or not finite; as IsForceClosure.
[[nodiscard]] double MeasureContactRegion(const object::Polygon& polygon,
                                          const grasp::Grasp& two_contacts, double half_angle,
                                          double limit);

/// Over the diameter: a tenth of what two points may differ by and still be the same.
inline constexpr double kRegionAccuracy = 1e-7;

}  // namespace regrasp::plan
