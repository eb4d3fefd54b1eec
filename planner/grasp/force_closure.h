#pragma once

#include <span>
#include <vector>

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

/// Non-owning arrays of N grasps with k contacts each.
/// Both arrays are N x k x 3 in row-major order: contact c of grasp g begins at (g · k + c) · 3.
struct GraspArrays {
  std::span<const double> points;
  std::span<const double> normals;  ///< unit vectors into the object
  int contacts = 0;                 ///< k, number of contacts per grasp
};

/// Optional computations of JudgeGrasps, and the number of threads.
struct JudgeOptions {
  double friction_angle = 0;  ///< friction angle, atan μ, radians in (0, π/2)
  object::WrenchFrame frame;
  /// Torsional friction length of all contacts (Contact::torsion), in the unit of the points.
  double torsion = 0;
  bool required_friction_angle = false;
  bool quality = false;
  int threads = 0;  ///< number of threads; 0: one per core of the machine
};

/// Results with one element per grasp, in input order; empty if not requested.
struct GraspVerdicts {
  std::vector<ForceClosure> force_closure;
  /// Smallest friction angle proved to be enough, radians; NaN if no angle below π/2 is enough.
  std::vector<double> required_friction_angle;
  std::vector<double> quality;        ///< lower bound of BoundQuality, dimensionless
  std::vector<double> quality_upper;  ///< upper bound of BoundQuality
};

/// Evaluate every grasp with TestForceClosure, ComputeRequiredFrictionAngle and BoundQuality.
///
/// Laws: each result is bit-identical to that of the function for a single grasp, for any number of
/// threads.
///
/// @throws std::invalid_argument  if an array does not have N x k x 3 values, the number of threads
///     is negative, the friction angle is invalid, or TestForceClosure rejects a grasp. The message
///     names the first such grasp, counted from 0.
[[nodiscard]] GraspVerdicts JudgeGrasps(const GraspArrays& grasps, const JudgeOptions& options);

}  // namespace regrasp::grasp
