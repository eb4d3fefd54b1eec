#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"

namespace regrasp::kinematics {

/// Names of a model's elements; those without one are "body 3", "joint 2".
[[nodiscard]] std::string BodyName(const mjModel& model, int body);
[[nodiscard]] std::string JointName(const mjModel& model, int joint);
[[nodiscard]] std::string ActuatorName(const mjModel& model, int actuator);

/// The three numbers of an element in one of MuJoCo's arrays.
[[nodiscard]] Eigen::Vector3d VectorAt(const mjtNum* numbers, int index);
/// The same of a place and a rotation.
[[nodiscard]] Eigen::Isometry3d PoseAt(const mjtNum* positions, const mjtNum* matrices, int index);

/// Whether a geom takes part in collisions.
[[nodiscard]] bool Collides(const mjModel& model, int geom);

/// Return the first body of the link that a body is part of: bodies without a joint between them
/// are one link. The first one has a joint, or the world as its parent.
[[nodiscard]] int LinkOf(const mjModel& model, int body);

/// The joints between a body and one above it, from the upper to the lower one.
[[nodiscard]] std::vector<int> JointsBetween(const mjModel& model, int above, int body);

struct CompiledModel;

/// Return the couplings of a model's fingers (joint_relations.h): each group of related joints has
/// one independent joint, which all others follow.
///
/// The independent joint is one that an actuator moves. If none or several are moved, it is one
/// that follows no other joint in the model.
/// @param fingers  joints of each finger, from the palm to the tip.
/// @param notes    gets the joints that share an actuator by a tendon, whose ratio is an
/// assumption.
/// @throws InputError  as ReadJointRelations, and if relations contradict each other.
[[nodiscard]] std::vector<HandDescription::Coupling> DeriveCouplings(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers,
    std::vector<std::string>& notes);

}  // namespace regrasp::kinematics
