#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// How a test with a margin ends.
enum class Decision { kNo, kTooClose, kYes };

/// The answer of the force-closure test with its margin.
struct ForceClosure {
  Decision decision = Decision::kNo;
  /// Bounds on the margin ε* (dimensionless, see TestForceClosure). Both have the sign of the
  /// decision; where the answer is clear early they are not tight.
  double margin_lower = 0;
  double margin_upper = 0;
};

/// What is within this of the border, relative to the size of the grasp's wrenches in the contacts'
/// own frame, is too close to call: a twist must separate by more, a ball about the origin or a
/// step beyond it be larger. Evaluating a wrench or a support loses some twenty roundings, 5e-15;
/// the rest is left for the inverse of the basic columns.
inline constexpr double kForceClosureEpsilon = 1e-12;

/// Decides force closure with circular friction cones (cone edges in the plane), in space and in
/// the plane, for any number of contacts, hard points and soft fingers (Contact::torsion).
///
/// Force closure holds iff the grasp matrix G (wrenches as in WrenchFrame) has full rank and forces
/// f_i in the interior of C(n_i, half_angle) with Σ G_i f_i = 0 exist (Murray, Li and Sastry 1994,
/// Prop. 5.3); of soft fingers G_i is of four columns, and what is inside is the force with the
/// torque about the normal. The margin is ε* = max ε over forces g_i ∈ C(n_i) with Σ n_i·g_i = 1
/// and Σ G_i (g_i + ε n_i) = 0; it is positive iff such interior forces exist, and infinite where
/// unit normal forces balance by themselves. It depends on neither the frame's origin nor its
/// radius.
///
/// kNo is certain by a twist, by a line through two contacts about which all others turn alike, or
/// by rank, kYes by a ball of wrenches. With contacts within 1e-7 of the grasp's radius no is too
/// close.
///
/// Laws: independent of the order of the contacts, of rigid motion and of the unit of length;
/// enlarging half_angle or a torsion or adding a contact never turns yes into no.
///
/// @param contacts    any number; fewer than 3 in space or 2 in the plane, or collinear ones in
///                    space, are never force closure where all are hard points. Soft fingers take
///                    two, at different points.
/// @param half_angle  θ in radians, in (0, π/2).
/// @throws std::invalid_argument  a value is not finite, a normal is not unit, θ out of range.
[[nodiscard]] ForceClosure TestForceClosure(std::span<const Contact> contacts,
                                            const object::WrenchFrame& frame, double half_angle);

/// True iff TestForceClosure says yes; what is too close to call is not force closure.
[[nodiscard]] bool IsForceClosure(std::span<const Contact> contacts,
                                  const object::WrenchFrame& frame, double half_angle);

}  // namespace regrasp::grasp
