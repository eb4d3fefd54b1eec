#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

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
