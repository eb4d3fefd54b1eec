#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Result of a test with a numerical margin.
enum class Decision { kNo, kTooClose, kYes };

/// Result of the force-closure test with its force-closure margin.
struct ForceClosure {
  Decision decision = Decision::kNo;
  /// Bounds on the margin ε* (dimensionless, see TestForceClosure). Both have the sign of the
  /// decision. They are not tight if the decision is clear early.
  double margin_lower = 0;
  double margin_upper = 0;
};

/// Numerical threshold of a decision, relative to the size of the grasp's wrenches in the contacts'
/// own frame. A twist must separate by more; a ball about the origin, or a step beyond it, must be
/// larger. Evaluating a wrench or a support has about twenty roundings, 5e-15. The remainder covers
/// the inverse of the basic columns.
inline constexpr double kForceClosureEpsilon = 1e-12;

/// Decide force closure with circular friction cones (cone edges in the plane).
/// The test covers space and the plane, any number of contacts, hard and soft fingers
/// (Contact::torsion).
///
/// A grasp is force closure iff the grasp matrix G (wrenches as in WrenchFrame) has full rank and
/// forces f_i in the interior of C(n_i, friction_angle) with Σ G_i f_i = 0 exist (Murray, Li and
/// Sastry 1994, Prop. 5.3). For soft fingers G_i has four columns, and the force together with the
/// torque about the normal must be in the interior. The margin is ε* = max ε over forces g_i ∈
/// C(n_i) with Σ n_i·g_i = 1 and Σ G_i (g_i + ε n_i) = 0. It is positive iff such interior forces
/// exist, and infinite if unit normal forces balance by themselves. It depends on neither the
/// frame's origin nor its radius.
///
/// kNo is certified by a twist, by a line through two contacts about which all others turn the
/// object in the same direction, or by rank. kYes is certified by a ball of wrenches. If contacts
/// are within 1e-7 of the grasp's radius of each other, a negative result is kTooClose.
///
/// Laws: independent of the order of the contacts, of rigid motion and of the unit of length; a
/// larger friction_angle or torsion or an additional contact never changes kYes into kNo.
///
/// @param contacts    any number of contacts. Fewer than 3 hard-finger contacts in space, fewer
///     than 2 in the plane, and collinear ones in space are never force closure. Two soft fingers
///     at different points suffice.
/// @param friction_angle  friction angle θ in radians, in (0, π/2).
/// @throws std::invalid_argument  if a value is not finite, a normal is not a unit vector, or θ is
///     out of range.
[[nodiscard]] ForceClosure TestForceClosure(std::span<const Contact> contacts,
                                            const object::WrenchFrame& frame,
                                            double friction_angle);

/// Return whether TestForceClosure decides kYes; kTooClose is not force closure.
[[nodiscard]] bool IsForceClosure(std::span<const Contact> contacts,
                                  const object::WrenchFrame& frame, double friction_angle);

}  // namespace regrasp::grasp
