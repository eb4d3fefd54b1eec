#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// A wrench in a WrenchFrame: force in newtons, torque about the frame's origin divided by its
/// radius, so newtons as well.
struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_over_radius = Eigen::Vector3d::Zero();
};

/// Contact forces that hold a load.
struct GraspForces {
  std::vector<Eigen::Vector3d> forces;  ///< newtons, one per contact, on the object
  /// About the normals, newtons times the unit of length, on the object; 0 of hard points.
  std::vector<double> torques;
  bool balanced = false;  ///< Σ G_i f_i + load = 0 and every f_i inside its cone
  /// Largest m such that every f_i lies in its cone with m · total_normal / k of normal force to
  /// spare: f_i − m (total_normal / k) n_i ∈ C(n_i). For a best effort minus the unbalanced wrench
  /// (the sum of the absolute values of its numbers in the frame) over total_normal.
  double margin = 0;
};

/// Contact forces, of soft fingers with torques, with Σ n_i·f_i = total_normal that balance `load`
/// with the largest margin inside the cones, to 1e-9. Where no forces inside the cones balance it,
/// the best effort, so that a bad grasp gets a fair try: cones and total respected, the unbalanced
/// wrench least in the sum of absolute values (L1, so it can depend on the frame's axes).
///
/// @param total_normal  sum of the normal forces, newtons, > 0.
/// @throws std::invalid_argument  as TestForceClosure; the load is not finite, total_normal not >
/// 0.
[[nodiscard]] GraspForces ComputeGraspForces(std::span<const Contact> contacts,
                                             const object::WrenchFrame& frame, double half_angle,
                                             const Wrench& load, double total_normal);

/// A contact of a grasp whose fingertip slides along the surface.
struct SlidingContact {
  int contact = 0;  ///< its place in the grasp
  /// Where the tip goes over the surface: of unit length, at right angles to the contact's normal;
  /// zero where it goes nowhere, and then friction does nothing.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// What balances fingertips that slide.
struct SlidingFriction {
  double mu = 0;          ///< of what slides
  double half_angle = 0;  ///< of the cones of the others, radians
};

/// Contact forces while some fingertips slide. Each of these presses with `sliding_normal` and
/// drags the object its way, f = sliding_normal · (n + μ direction), on the edge of its cone; the
/// others balance that and the load with the largest margin inside theirs (ComputeGraspForces).
///
/// Laws: without sliding contacts the same as ComputeGraspForces; independent of rigid motion.
///
/// @param total_normal    sum of all normal forces, more than what the sliding ones press with.
/// @returns forces in the order of the grasp; `margin` is that of the others, and where all slide
///     minus what is not balanced.
/// @throws std::invalid_argument  as ComputeGraspForces.
[[nodiscard]] GraspForces ComputeSlidingForces(const Grasp& grasp,
                                               std::span<const SlidingContact> sliding,
                                               const object::WrenchFrame& frame,
                                               const SlidingFriction& friction, const Wrench& load,
                                               double total_normal, double sliding_normal);

/// What a sliding fingertip presses with, and how well the others balance it.
struct SlidingNormal {
  double normal = 0;
  double margin = 0;
};

/// Of the normal forces `least`, `least` · 1.5, … up to `most` the first that leaves the others a
/// good margin (kGoodSlidingMargin), otherwise the one with the largest, searched for between these
/// too: two others balance a sliding fingertip at one normal force only, if at all.
/// @param margin  of the others at a normal force, quasi-concave as that of ComputeSlidingForces;
///     called at least once.
[[nodiscard]] SlidingNormal ChooseSlidingNormal(double least, double most,
                                                const std::function<double(double)>& margin);

/// With this share of the mean normal force to spare inside the cones of the others a larger force
/// of what slides is not worth it.
inline constexpr double kGoodSlidingMargin = 0.05;

}  // namespace regrasp::grasp
