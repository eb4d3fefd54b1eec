#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

/// Return the name of a model element; unnamed elements are called "body 3", "joint 2".
[[nodiscard]] std::string BodyName(const mjModel& model, int body);
[[nodiscard]] std::string JointName(const mjModel& model, int joint);
[[nodiscard]] std::string ActuatorName(const mjModel& model, int actuator);

/// Return the three numbers of an element in an array of MuJoCo.
[[nodiscard]] Eigen::Vector3d VectorAt(const mjtNum* numbers, int index);
/// Return the pose of an element from MuJoCo's arrays of positions and rotation matrices.
[[nodiscard]] Eigen::Isometry3d PoseAt(const mjtNum* positions, const mjtNum* matrices, int index);

/// Return whether a geom takes part in collisions.
[[nodiscard]] bool Collides(const mjModel& model, int geom);

/// Return the first body of the link that contains a body.
/// A link is a set of bodies without joints between them. Its first body has a joint or is a child
/// of the world.
[[nodiscard]] int LinkOf(const mjModel& model, int body);

/// Return the joints between a body and an ancestor of it, from the upper to the lower one.
[[nodiscard]] std::vector<int> JointsBetween(const mjModel& model, int above, int body);

struct CompiledModel;

/// Return the couplings of a model's fingers (joint_relations.h).
///
/// Each group of related joints has one independent joint, which all other joints of the group
/// follow. It is a joint that an actuator moves. If none or several are moved by actuators, it is
/// preferably one that follows no other joint in the model.
/// @param fingers  joints of each finger, from the palm to the fingertip.
/// @param notes    receives the joints that share an actuator by a tendon, whose ratio is an
///     assumption.
/// @throws InputError  as ReadJointRelations, and if relations contradict each other.
[[nodiscard]] std::vector<HandDescription::Coupling> DeriveCouplings(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers,
    std::vector<std::string>& notes);

struct CompiledModel;

/// Actuator that moves a joint.
/// A URDF model has none. The replay adds one to each independent joint, limited by the joint's
/// `effort`.
struct JointActuator {
  std::string joint;
  std::string actuator;
  double largest_torque = 0;  ///< N m at the joint; 0: unknown
};

/// Return the actuators of all joints of a model, including those that act by a tendon.
[[nodiscard]] std::vector<JointActuator> ActuatorsOf(const CompiledModel& compiled);

/// Return why a simulation of a hand's actuators can be incomplete, one sentence per reason.
/// The reasons are independent joints without an actuator, whose plans are not simulated, and
/// joints with an unknown largest torque, which counts as unlimited.
[[nodiscard]] std::vector<std::string> ActuationWarnings(const HandModel& hand,
                                                         const CompiledModel& compiled);

}  // namespace regrasp::kinematics
