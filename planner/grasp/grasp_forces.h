#pragma once

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

}  // namespace regrasp::grasp
