#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "planner/kinematics/hand_model.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// The servo of an independent joint (kinematics::Finger::drives) in the hand's model.
struct DriveServo {
  double stiffness = 0;      ///< N m / rad
  double damping = 0;        ///< damping of the actuator alone, N m s/rad
  double joint_damping = 0;  ///< damping of the joints that it moves, N m s/rad
  double limit = std::numeric_limits<double>::infinity();  ///< largest torque, N m
  /// Range of its control in the model's units (`ctrlrange`). None if the model has none, or if the
  /// servo is derived; then `limit` includes it.
  std::optional<std::array<double, 2>> control_range = std::nullopt;
  /// whether stiffness and damping are chosen here, since the model has no servo
  bool derived = false;
  /// stiffness in the model, N m / rad, if a joint loop of the controller raises it; otherwise 0
  double model_stiffness = 0;
};

/// No actuator moves an independent joint of a hand.
class NoActuatorError : public InputError {
 public:
  using InputError::InputError;
};

/// The actuator that moves an independent joint.
struct DriveActuator {
  int actuator = -1;  ///< index of the actuator in the model
  double moment = 0;  ///< torque of the joint per newton (metre) of the actuator
  DriveServo servo;
};

/// Find the actuator with the largest moment about an independent joint, and make it a servo.
/// An actuator without a servo in the model gets one with critical damping. The inertia for it is
/// at least that of a small electric finger. Constants of the model that depend on inertias are
/// stale afterwards (mj_setConst). A servo of the model keeps the range of its control. If the
/// servo is derived, the range of the control becomes a limit of its force, because its control is
/// then an angle.
/// @param joints        joints of the model, in the order of the finger's joints.
/// @param force_factor  factor on the force limit of the model.
/// @param data          data of the model with the moments of actuators, in any joint
///     configuration.
/// @throws NoActuatorError  if no actuator moves the joint.
[[nodiscard]] DriveActuator FindServo(const kinematics::Finger& finger,
                                      const std::vector<int>& joints, int drive,
                                      double force_factor, const mjData_& data, mjModel_& model);

}  // namespace regrasp::sim
