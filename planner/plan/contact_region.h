#pragma once

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::plan {

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
