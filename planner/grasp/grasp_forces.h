#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/grasp/quality.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Wrench in a WrenchFrame.
/// Both parts are in newtons: the torque about the frame's origin is divided by its radius.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_over_radius = Eigen::Vector3d::Zero();
};

/// Contact forces that balance a load.
struct GraspForces {
  std::vector<Eigen::Vector3d> forces;  ///< forces on the object, newtons, one per contact
  /// Torques on the object about the normals, newtons times the unit of length; 0 for hard-finger
  /// contacts.
  std::vector<double> torques;
  bool balanced = false;  ///< whether Σ G_i f_i + load = 0 and every f_i is inside its cone
  /// Force margin: largest m for which every f_i is inside its cone by m · total_normal / k of
  /// normal force, f_i − m (total_normal / k) n_i ∈ C(n_i). If not balanced, minus the unbalanced
  /// wrench (sum of the absolute values of its numbers in the frame) over total_normal.
  double margin = 0;
};

/// Compute the contact forces that balance `load` with the largest margin inside the cones.
/// For soft fingers they include torques. Σ n_i·f_i = total_normal, and the margin is optimal to
/// 1e-9. If no forces inside the cones balance the load, the result minimizes the unbalanced wrench
/// within cones and total, so that a replay also tests bad grasps. The minimized norm is the sum of
/// absolute values (L1), so the result can depend on the frame's axes.
///
/// @param total_normal  sum of the normal forces, newtons, > 0.
/// @throws std::invalid_argument  as TestForceClosure, if the load is not finite, or if
///     total_normal is not > 0.
[[nodiscard]] GraspForces ComputeGraspForces(std::span<const Contact> contacts,
                                             const object::WrenchFrame& frame,
                                             double friction_angle, const Wrench& load,
                                             double total_normal);

/// Compute the contact forces of at most `most_normal` that balance a load.
/// As ComputeGraspForces, but with Σ n_i·f_i ≤ most_normal: fingers that carry an object from below
/// cannot press against each other, so that the sum of their normal forces follows from the load.
/// The forces have the largest margin; for a force-closure grasp their sum is most_normal.
/// @param most_normal  largest sum of the normal forces, newtons, > 0. The margin is relative to
/// it.
/// @throws std::invalid_argument  as ComputeGraspForces.
[[nodiscard]] GraspForces ComputeSupportForces(std::span<const Contact> contacts,
                                               const object::WrenchFrame& frame,
                                               double friction_angle, const Wrench& load,
                                               double most_normal);

/// Contact of a grasp whose fingertip slides along the surface.
struct SlidingContact {
  int contact = 0;  ///< index of the contact in the grasp
  /// Unit vector of the fingertip's motion along the surface, perpendicular to the contact's
  /// normal. Zero for a fingertip that does not move and then has no friction force.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Friction of a grasp with sliding fingertips.
struct SlidingFriction {
  double mu = 0;              ///< friction coefficient of the sliding contacts
  double friction_angle = 0;  ///< friction angle of the cones of the other contacts, radians
};

/// Compute contact forces while some fingertips slide.
/// Each sliding fingertip applies f = sliding_normal · (n + μ direction), which is on the edge of
/// its cone. The other contacts balance these forces and the load with the largest margin inside
/// their cones (ComputeGraspForces).
///
/// Laws: without sliding contacts the same as ComputeGraspForces; independent of rigid motion.
///
/// @param total_normal    sum of all normal forces, larger than the sum over the sliding contacts.
/// @returns forces in the order of the grasp. `margin` is that of the non-sliding contacts; if all
///     contacts slide, it is minus the unbalanced wrench.
/// @throws std::invalid_argument  as ComputeGraspForces.
[[nodiscard]] GraspForces ComputeSlidingForces(const Grasp& grasp,
                                               std::span<const SlidingContact> sliding,
                                               const object::WrenchFrame& frame,
                                               const SlidingFriction& friction, const Wrench& load,
                                               double total_normal, double sliding_normal);

/// Normal force of a sliding fingertip, and the force margin of the other contacts.
struct SlidingNormal {
  double normal = 0;
  double margin = 0;
};

/// Choose the normal force of a sliding fingertip.
/// Returns the first of `least`, `least` · 1.5, … up to `most` at which the other contacts have a
/// good margin (kGoodSlidingMargin). Otherwise it returns the force with the largest margin, and
/// also searches between these forces: two contacts balance a sliding fingertip at one normal force
/// only, if at all.
/// @param margin  margin of the other contacts as a function of the normal force, quasi-concave as
///     that of ComputeSlidingForces; called at least once.
[[nodiscard]] SlidingNormal ChooseSlidingNormal(double least, double most,
                                                const std::function<double(double)>& margin);

/// Force margin, as a share of the mean normal force, above which a larger force of the sliding
/// contacts is not worthwhile.
inline constexpr double kGoodSlidingMargin = 0.05;

/// Compute the largest s at which forces inside the friction cones balance a load.
/// The forces with Σ n_i·f_i = total_normal balance `load` + s · total_normal · `direction`:
///
///     max s   subject to   Σ G_i f_i + load + s · total_normal · direction = 0,   f_i ∈ C(n_i).
///
/// This is a linear program over the circular cones (planner/grasp/wrench_simplex.h); its dual
/// certifies `upper`. With a direction of unit length and no load, s is the distance from the
/// origin to the boundary of Ferrari and Canny's wrench set along −direction. It is then at least
/// the quality ε of a force-closure grasp.
///
/// Laws: concave in the load. Every smaller s ≥ 0 is balanced too, because the set of balanced
/// loads is convex. Never decreases when the friction angle increases.
///
/// @param direction  direction of the load, not zero.
/// @returns bounds on s; nullopt if not even `load` is balanced.
/// @throws std::invalid_argument  as ComputeGraspForces, or if the direction is zero or not finite.
[[nodiscard]] std::optional<QualityBounds> ComputeLargestLoad(
    std::span<const Contact> contacts, const object::WrenchFrame& frame, double friction_angle,
    const Wrench& load, const Wrench& direction, double total_normal);

}  // namespace regrasp::grasp
