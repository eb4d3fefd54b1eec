#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "planner/kinematics/hand_model.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// The servo of a drive (kinematics::Finger::drives) as the hand's model has it.
struct DriveServo {
  double stiffness = 0;      ///< N m / rad
  double damping = 0;        ///< N m s / rad, of the actuator alone
  double joint_damping = 0;  ///< N m s / rad, of the joints that it turns
  double limit = std::numeric_limits<double>::infinity();  ///< largest torque, N m
  /// Range of its control in the model's units (`ctrlrange`); none if the model gives none, or if
  /// the servo is derived, whose limit has it.
  std::optional<std::array<double, 2>> control_range = std::nullopt;
  bool derived = false;  ///< the model has no servo: its stiffness and damping are chosen here
};

/// The actuator that turns a drive.
struct DriveActuator {
  int actuator = -1;  ///< of the model
  double moment = 0;  ///< torque of the drive for each newton (metre) of the actuator
  DriveServo servo;
};

/// Finds the actuator that turns a drive most, and makes it a servo where the model has none: with
/// critical damping, and the inertia of a small gear motor at least. Constants of the model that
/// depend on inertias are stale then (mj_setConst).
/// A servo of the model keeps the range of its control. If the servo is derived, the range of the
/// control becomes a limit of its force, because its control is an angle from then on.
/// @param joints        of the model, in the order of the finger's.
/// @param force_factor  of the limit, times what the model has.
/// @param data          with the moments of actuators in some posture.
/// @throws InputError  no actuator turns it.
[[nodiscard]] DriveActuator FindServo(const kinematics::Finger& finger,
                                      const std::vector<int>& joints, int drive,
                                      double force_factor, const mjData_& data, mjModel_& model);

}  // namespace regrasp::sim
