#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/actuation/hand_scene.h"
#include "sim/actuation/link_tree.h"

namespace regrasp::sim {

/// Coupling of two successive joints of a finger.
/// The speed of the joint of `link` is `ratio` times the speed of its parent's joint.
struct LinkCoupling {
  int link = 0;  ///< index in the tree
  double ratio = 1;
};

/// Return the couplings of a hand's joints, those of coupled joints of one finger with the next.
/// Constraints of the model are not read. On joints of fingers they are these couplings
/// (kinematics::ReadJointRelations), and other joints are fixed.
/// @throws InputError  if a joint between coupled joints is not coupled to them, or if the axes of
///     successive coupled joints coincide.
[[nodiscard]] std::vector<LinkCoupling> LinkCouplingsOf(const HandScene& scene,
                                                        const LinkTree& tree);

/// Axis of a revolute joint: a point and a unit vector.
struct JointAxis {
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// Line of a rod: a point and a unit vector.
struct RodLine {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

/// Return the line of a rigid rod that couples two successive joints.
/// The rod connects the parent of the first joint to the link of the second, as in the four-bar
/// linkage of a finger. It keeps the velocity of the link at `point` along `direction`, relative to
/// the parent, at zero. Engines whose constraints involve two bodies can simulate it, whereas the
/// relation of the joints' speeds involves three.
///
/// Law: a unit force on the line has the torques −ratio · c about the first axis and c about the
/// second, with c > 0. The velocity is then c · (second speed − ratio · first speed).
/// @pre the axes do not coincide.
[[nodiscard]] RodLine RodLineOf(const JointAxis& first, const JointAxis& second, double ratio);

}  // namespace regrasp::sim
