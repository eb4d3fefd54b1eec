#include "planner/kinematics/joint_actuators.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

/// Largest number of names in a message; the rest is counted.
constexpr std::size_t kListedJoints = 6;

/// Return the largest force of an actuator; 0 if it has no limit.
/// The control range of a servo limits angles, not forces.
double LargestForce(const mjModel& model, int actuator) {
  const auto largest = [&](const mjtNum* ranges) {
    return std::max(std::abs(ranges[2 * actuator]), std::abs(ranges[2 * actuator + 1]));
  };
  if (model.actuator_forcelimited[actuator] != 0) return largest(model.actuator_forcerange);
  const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * actuator;
  const bool servo = model.actuator_biastype[actuator] == mjBIAS_AFFINE && bias[1] < 0;
  if (servo || model.actuator_ctrllimited[actuator] == 0) return 0;
  const double gain = std::abs(model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * actuator]);
  return gain * largest(model.actuator_ctrlrange);
}

std::vector<JointActuator> ActuatorsOfUrdf(const CompiledModel& compiled) {
  std::vector<JointActuator> actuators;
  for (int joint = 0; joint < compiled.model->njnt; ++joint) {
    const std::string name = JointName(*compiled.model, joint);
    const auto effort = compiled.text.efforts.find(name);
    const double torque = effort == compiled.text.efforts.end() ? 0 : effort->second;
    actuators.push_back({name, "a motor of its effort", torque});
  }
  return actuators;
}

std::string ListOf(const std::vector<std::string>& names) {
  std::string text = names.size() == 1 ? "joint " : "joints ";
  for (std::size_t i = 0; i < std::min(names.size(), kListedJoints); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kListedJoints) {
    text += " and " + std::to_string(names.size() - kListedJoints) + " more";
  }
  return text;
}

}  // namespace

std::vector<JointActuator> ActuatorsOf(const CompiledModel& compiled) {
  if (compiled.text.root.name == "robot") return ActuatorsOfUrdf(compiled);
  const mjModel& model = *compiled.model;
  std::vector<JointActuator> actuators;
  for (int i = 0; i < model.nu; ++i) {
    const std::string name = ActuatorName(model, i);
    const int target = model.actuator_trnid[2 * i];
    const int type = model.actuator_trntype[i];
    const double gear = std::abs(model.actuator_gear[std::ptrdiff_t{6} * i]);
    const double torque = gear * LargestForce(model, i);
    if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT) {
      actuators.push_back({JointName(model, target), name, torque});
    } else if (type == mjTRN_TENDON) {
      const int first = model.tendon_adr[target];
      for (int k = 0; k < model.tendon_num[target]; ++k) {
        if (model.wrap_type[first + k] != mjWRAP_JOINT) continue;
        actuators.push_back({JointName(model, model.wrap_objid[first + k]), name,
                             std::abs(model.wrap_prm[first + k]) * torque});
      }
    }
  }
  return actuators;
}

std::vector<std::string> ActuationWarnings(const HandModel& hand, const CompiledModel& compiled) {
  const std::vector<JointActuator> actuators = ActuatorsOf(compiled);
  if (actuators.empty()) return {"the model has no actuators: plans are not simulated"};
  std::vector<std::string> unmoved;
  std::vector<std::string> unlimited;
  for (const Finger& finger : hand.fingers) {
    for (int drive = 0; drive < finger.drives; ++drive) {
      const JointActuator* strongest = nullptr;
      for (const JointActuator& actuator : actuators) {
        const auto joint = std::ranges::find(finger.joints, actuator.joint, &Joint::name);
        if (joint == finger.joints.end() || joint->drive != drive) continue;
        // In a URDF model the independent joint has the actuator.
        if (compiled.text.root.name == "robot" && joint->follows) continue;
        const bool stronger =
            strongest == nullptr || actuator.largest_torque == 0 ||
            (strongest->largest_torque > 0 && actuator.largest_torque > strongest->largest_torque);
        if (stronger) strongest = &actuator;
      }
      const std::string& name = LeadingJoint(finger, drive).name;
      if (strongest == nullptr) unmoved.push_back(name);
      if (strongest != nullptr && strongest->largest_torque == 0) unlimited.push_back(name);
    }
  }
  std::vector<std::string> warnings;
  if (!unmoved.empty()) {
    warnings.push_back(ListOf(unmoved) + (unmoved.size() == 1 ? " has" : " have") +
                       " no actuator: plans are not simulated");
  }
  if (!unlimited.empty()) {
    warnings.push_back("the largest torque of " + ListOf(unlimited) +
                       " is unknown and taken as unlimited");
  }
  return warnings;
}

}  // namespace regrasp::kinematics
