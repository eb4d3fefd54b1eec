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

/// Refuse forces of tendons.
void CheckTendons(const mjModel& model) {
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
}

/// Return the length of an actuator at the angle 0 of its independent joint.
/// @throws InputError  if it acts on other joints, or if its lengths are not sums of angles.
double LengthAtZero(const HandScene& scene, FingerIndex finger, int drive, int actuator) {
  const mjModel& model = *scene.model;
  const std::vector<kinematics::Joint>& joints = scene.hand.fingers[finger].joints;
  std::vector<mjtNum> moments(
      scene.data->actuator_moment + std::ptrdiff_t{actuator} * model.nv,
      scene.data->actuator_moment + std::ptrdiff_t{actuator + 1} * model.nv);
  double length = 0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (joints[k].drive != drive) continue;
    mjtNum& moment = moments[model.jnt_dofadr[scene.fingers[finger].joints[k]]];
    length += moment * joints[k].coupling_offset;
    moment = 0;
  }
  const int kind = model.actuator_trntype[actuator];
  const bool sums_angles =
      kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT || kind == mjTRN_TENDON;
  const bool is_alone = std::ranges::all_of(moments, [](mjtNum moment) { return moment == 0; });
  if (!sums_angles || !is_alone || model.actuator_dyntype[actuator] != mjDYN_NONE) {
    Refuse("actuator " + kinematics::ActuatorName(model, actuator) +
           " with a state or several independent joints");
  }
  return length;
}

/// Let the actuator of an independent joint act on the joint that the others follow. A coupling
/// distributes its torque, so that the motion is that of an actuator on all of them.
void AddActuator(const HandScene& scene, FingerIndex finger, int independent, JointDrive& drive) {
  const mjModel& model = *scene.model;
  const DriveActuator& found = scene.fingers[finger].drives[independent];
  const int a = found.actuator;
  const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
  drive.actuator = a;
  drive.moment = found.moment;
  drive.gain = model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a];
  drive.constant = bias[0] + bias[1] * LengthAtZero(scene, finger, independent, a);
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
  CheckTendons(*scene.model);
  std::vector<JointDrive> drives(tree.links().size());
  for (FingerIndex f{0}; f < std::ssize(scene.fingers); ++f) {
    const HandScene::Finger& finger = scene.fingers[f];
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      JointDrive& drive = drives[tree.link(f, k)];
      AddPassive(*scene.model, drive, finger.joints[k]);
      const kinematics::Finger& chain = scene.hand.fingers[f];
      const kinematics::Joint& joint = chain.joints[k];
      if (joint.follows) continue;
      // These limits are such that following joints are within theirs.
      drive.is_limited = true;
      drive.lower = chain.lower[joint.drive];
      drive.upper = chain.upper[joint.drive];
      AddActuator(scene, f, joint.drive, drive);
    }
  }
  return drives;
}

}  // namespace regrasp::sim
