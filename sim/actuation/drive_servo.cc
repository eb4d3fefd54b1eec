#include "sim/actuation/drive_servo.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::sim {
namespace {

/// Servo constants if the model has no servo, as for small electric fingers: stiffness, N m/rad,
/// and inertia of an actuator behind its gear, kg m².
constexpr double kServoStiffness = 4;
constexpr double kServoInertia = 1e-3;
/// Time constant of a raised servo, damping over stiffness, seconds.
constexpr double kDampingTime = 0.02;

/// @returns the critical damping for the inertia that an independent joint moves, at least that of
///     a small electric actuator with gear.
double MakeCritical(const kinematics::Finger& finger, const std::vector<int>& joints, int drive,
                    double stiffness, mjModel& model) {
  double inertia = 0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (finger.joints[k].drive != drive) continue;
    const int dof = model.jnt_dofadr[joints[k]];
    inertia += model.dof_M0[dof] - model.dof_armature[dof];
    model.dof_armature[dof] = std::max(model.dof_armature[dof], kServoInertia);
    inertia += model.dof_armature[dof];
  }
  return 2 * std::sqrt(stiffness * inertia);
}

/// Return the largest value that a range contains with both signs.
/// @param range  lower and upper limit.
/// @param what  quantity of the range, for the message.
/// @throws InputError  if there is none: the actuator acts in one direction only.
double SymmetricLimit(const mjtNum* range, const std::string& what, const mjModel& model,
                      int actuator) {
  const double limit = std::min(-range[0], range[1]);
  if (limit > 0) return limit;
  const char* name = mj_id2name(&model, mjOBJ_ACTUATOR, actuator);
  throw InputError("hand model: " + what + " range of actuator " +
                   (name == nullptr ? std::to_string(actuator) : std::string(name)) +
                   ": expected negative and positive values, found " + FormatShort(range[0]) +
                   " to " + FormatShort(range[1]));
}

/// Give the actuator the law of its servo.
void MakeServo(const DriveActuator& found, mjModel& model) {
  const double stiffness = found.servo.stiffness / (found.moment * found.moment);
  const double damping = found.servo.damping / (found.moment * found.moment);
  const int a = found.actuator;
  model.actuator_gaintype[a] = mjGAIN_FIXED;
  model.actuator_biastype[a] = mjBIAS_AFFINE;
  model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a] = stiffness;
  mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
  bias[0] = 0;
  bias[1] = -stiffness;
  bias[2] = -damping;
}

}  // namespace

DriveActuator FindServo(const kinematics::Finger& finger, const std::vector<int>& joints, int drive,
                        double force_factor, const mjData_& data, mjModel_& model) {
  DriveActuator found;
  for (int actuator = 0; actuator < model.nu; ++actuator) {
    double moment = 0;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      if (finger.joints[k].drive != drive) continue;
      const int dof = model.jnt_dofadr[joints[k]];
      moment +=
          finger.joints[k].ratio * data.actuator_moment[std::ptrdiff_t{actuator} * model.nv + dof];
    }
    if (std::abs(moment) > std::abs(found.moment)) {
      found.actuator = actuator;
      found.moment = moment;
    }
  }
  if (found.actuator < 0) {
    throw NoActuatorError("hand model: actuator of joint " +
                          kinematics::LeadingJoint(finger, drive).name + " not found");
  }
  const int a = found.actuator;
  const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * a;
  const bool servo = model.actuator_biastype[a] == mjBIAS_AFFINE && bias[1] < 0;
  DriveServo& law = found.servo;
  law.derived = !servo;
  law.stiffness = servo ? -bias[1] * found.moment * found.moment : kServoStiffness;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const kinematics::Joint& joint = finger.joints[k];
    if (joint.drive != drive) continue;
    law.joint_damping += joint.ratio * joint.ratio * model.dof_damping[model.jnt_dofadr[joints[k]]];
  }
  law.damping = servo ? -bias[2] * found.moment * found.moment
                      : MakeCritical(finger, joints, drive, law.stiffness, model);
  mjtNum* range = model.actuator_forcerange + std::ptrdiff_t{2} * a;
  double limit = std::numeric_limits<double>::infinity();
  if (model.actuator_forcelimited[a] != 0) limit = SymmetricLimit(range, "force", model, a);
  if (!servo && model.actuator_ctrllimited[a] != 0) {
    const mjtNum* control = model.actuator_ctrlrange + std::ptrdiff_t{2} * a;
    const double gain = std::abs(model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * a]);
    limit = std::min(limit, gain * SymmetricLimit(control, "control", model, a));
  }
  if (servo && law.stiffness < kServoStiffness) {
    law.model_stiffness = law.stiffness;
    law.stiffness = kServoStiffness;
    law.damping = std::max(law.damping, kDampingTime * kServoStiffness - law.joint_damping);
    MakeServo(found, model);
  }
  if (!servo) {
    MakeServo(found, model);
    model.actuator_ctrllimited[a] = 0;
  } else if (model.actuator_ctrllimited[a] != 0) {
    const mjtNum* control = model.actuator_ctrlrange + std::ptrdiff_t{2} * a;
    law.control_range = {control[0], control[1]};
  }
  if (std::isfinite(limit)) {
    limit *= force_factor;
    range[0] = -limit;
    range[1] = limit;
    model.actuator_forcelimited[a] = 1;
    law.limit = limit * std::abs(found.moment);
  }
  return found;
}

}  // namespace regrasp::sim
