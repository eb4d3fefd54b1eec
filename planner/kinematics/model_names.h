#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

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

}  // namespace regrasp::kinematics
