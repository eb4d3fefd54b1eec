#include "sim/actuation/joint_drive.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "planner/base/error.h"
#include "planner/kinematics/derive_couplings.h"

namespace regrasp::sim {
namespace {

[[noreturn]] void Refuse(const std::string& what) {
  throw InputError("engine ode: " + what + " not supported");
}

/// Refuse couplings and forces of tendons.
void CheckTendons(const HandScene& scene) {
  const mjModel& model = *scene.model;
  for (const kinematics::Finger& finger : scene.hand.fingers) {
    for (const kinematics::Joint& joint : finger.joints) {
      if (!joint.follows && finger.drives == std::ssize(finger.joints)) continue;
      Refuse("coupled joints of finger " + finger.name);
    }
  }
  for (int i = 0; i < model.neq; ++i) {
    if (model.eq_active[i] != 0) Refuse("equality constraints of the hand model");
  }
  for (int i = 0; i < model.ntendon; ++i) {
    if (model.tendon_stiffness[i] != 0 || model.tendon_damping[i] != 0 ||
        model.tendon_frictionloss[i] != 0 || model.tendon_limited[i] != 0) {
      Refuse("tendons with stiffness, damping, friction or limits");
    }
  }
}

void AddPassive(const mjModel& model, JointDrive& drive, int joint) {
  const int dof = model.jnt_dofadr[joint];
  drive.armature = model.dof_armature[dof];
  drive.damping = model.dof_damping[dof];
  drive.stiffness = model.jnt_stiffness[joint];
  drive.spring = model.qpos_spring[model.jnt_qposadr[joint]];
  drive.friction = model.dof_frictionloss[dof];
  drive.is_limited = model.jnt_limited[joint] != 0;
  drive.lower = model.jnt_range[std::ptrdiff_t{2} * joint];
  drive.upper = model.jnt_range[std::ptrdiff_t{2} * joint + 1];
}

void AddActuator(const mjModel& model, const DriveActuator& found, int joint, JointDrive& drive) {
  const int a = found.actuator;
  const int kind = model.actuator_trntype[a];
  const bool on_joint = kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT;
  if (!on_joint || model.actuator_trnid[std::ptrdiff_t{2} * a] != joint ||
      model.actuator_dyntype[a] != mjDYN_NONE) {
    Refuse("actuator " + kinematics::ActuatorName(model, a) + " with a state or several joints");
  }
  const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
  drive.actuator = a;
  drive.moment = found.moment;
  drive.gain = model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a];
  drive.constant = bias[0];
  drive.per_angle = bias[1] * found.moment;
  drive.per_speed = bias[2] * found.moment;
  drive.is_force_limited = model.actuator_forcelimited[a] != 0;
  drive.least_force = model.actuator_forcerange[std::ptrdiff_t{2} * a];
  drive.largest_force = model.actuator_forcerange[std::ptrdiff_t{2} * a + 1];
}

}  // namespace

JointDrive::Law JointDrive::LawFor(const Input& input, int saturated) const {
  const double h = input.timestep;
  Law law;
  law.slope = armature / h + damping + h * stiffness;
  law.offset = armature / h * input.speed - stiffness * (input.angle - spring);
  if (actuator < 0) return law;
  if (saturated != 0) {
    law.offset += moment * (saturated < 0 ? least_force : largest_force);
    return law;
  }
  law.slope -= moment * (h * per_angle + per_speed);
  law.offset += moment * (gain * input.control + constant + per_angle * input.angle);
  return law;
}

double JointDrive::FreeForce(const Input& input, double speed) const {
  return gain * input.control + constant + per_angle * (input.angle + input.timestep * speed) +
         per_speed * speed;
}

double JointDrive::Force(const Input& input, double speed) const {
  if (actuator < 0) return 0;
  const double force = FreeForce(input, speed);
  return is_force_limited ? std::clamp(force, least_force, largest_force) : force;
}

int JointDrive::Saturation(const Input& input, double speed) const {
  if (actuator < 0 || !is_force_limited) return 0;
  const double force = FreeForce(input, speed);
  return force < least_force ? -1 : force > largest_force ? 1 : 0;
}

std::vector<JointDrive> JointDrivesOf(const HandScene& scene, const LinkTree& tree) {
  CheckTendons(scene);
  std::vector<JointDrive> drives(tree.links().size());
  for (FingerIndex f{0}; f < std::ssize(scene.fingers); ++f) {
    const HandScene::Finger& finger = scene.fingers[f];
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      JointDrive& drive = drives[tree.link(f, k)];
      AddPassive(*scene.model, drive, finger.joints[k]);
      AddActuator(*scene.model, finger.drives[scene.hand.fingers[f].joints[k].drive],
                  finger.joints[k], drive);
    }
  }
  return drives;
}

}  // namespace regrasp::sim
