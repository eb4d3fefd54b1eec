#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::sim {

/// Finger that presses on an object with servos at constant targets, in the palm's frame.
struct StiffFinger {
  const kinematics::Finger* finger = nullptr;
  kinematics::JointConfiguration configuration;
  Eigen::VectorXd stiffness;  ///< stiffness of the servo of each independent joint, N m/rad, > 0
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d inward = Eigen::Vector3d::Zero();   ///< normal into the object, a unit vector
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< force on the object, newtons
};

/// Stiffness of a grasp: minus the derivative of the wrench of its fingers with respect to a
/// displacement of the object. Both are about the object's centroid, in the palm's frame. Torques
/// are divided by a radius, and rotations multiplied by it, so that all entries are in N/m.
using GraspStiffness = Eigen::Matrix<double, 6, 6>;

/// Compute the stiffness of a grasp whose fingertips roll without slip.
///
/// The servos have constant targets and torques. A finger moves with the object: its fingertip
/// sphere rolls on the surface, which is flat near the contact. Its other degrees of freedom follow
/// from the balance of torques. Forces contribute, because they act at contacts that move and
/// through moment arms that change: large grasp forces destabilize a grasp like a column under load
/// (Cutkosky and Kao, Computing and controlling the compliance of a robotic hand, 1989).
///
/// Laws: without forces symmetric and positive semidefinite; linear in stiffness and forces
/// together; the eigenvalues do not change by rigid motion.
/// @param centroid  centroid of the object.
/// @param radius    metres, > 0.
[[nodiscard]] GraspStiffness ComputeGraspStiffness(const std::vector<StiffFinger>& fingers,
                                                   const Eigen::Vector3d& centroid, double radius);

/// Return the smallest eigenvalue of the symmetric part, N/m.
/// The grasp is stable if it is positive, since every displacement then costs energy.
[[nodiscard]] double SmallestStiffness(const GraspStiffness& stiffness);

}  // namespace regrasp::sim
