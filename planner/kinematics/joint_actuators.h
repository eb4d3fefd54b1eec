#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// An actuator that moves a joint. A URDF has none: the replay gives each independent joint a motor
/// that is as strong as the joint's effort.
struct JointActuator {
  std::string joint;
  std::string actuator;
  double largest_torque = 0;  ///< N m at the joint; 0: unknown
};

/// Return the actuators of all joints of a model, by joint and tendon.
[[nodiscard]] std::vector<JointActuator> ActuatorsOf(const CompiledModel& compiled);

/// Return what a verdict on the actuators of a hand cannot rely on, one sentence each: independent
/// joints that no actuator moves, whose plans are not simulated, and joints whose largest torque is
/// unknown, which is taken as unlimited.
[[nodiscard]] std::vector<std::string> ActuationWarnings(const HandModel& hand,
                                                         const CompiledModel& compiled);

}  // namespace regrasp::kinematics
