#pragma once

#include <string>
#include <vector>

namespace regrasp::kinematics {

struct CompiledModel;

/// Linear relation that a model imposes on two joints of one finger.
/// The relation is angle of `joint` = ratio · angle of `leader` + offset, radians.
struct JointRelation {
  int joint = 0;   ///< joint of the model, different from `leader`
  int leader = 0;  ///< joint of the model that the relation names as the independent one
  double ratio = 1;
  double offset = 0;
  /// Whether only the sum of the angles is imposed, by a fixed tendon with one actuator. The ratio
  /// is then that of the tendon's coefficients, which the real hand can violate.
  bool shares_actuator = false;
  std::string source;  ///< element that imposes it, for messages: "<mimic> of joint ff2"
};

/// Return all relations that a model imposes on the joints of its fingers.
///
/// The sources are active equality constraints of joints and of fixed tendons, URDF `<mimic>`
/// elements, and fixed tendons with an actuator. Constraints that involve no joint of a finger are
/// skipped. A constraint on angles beyond the reference position is converted to angles.
/// @param fingers  joints of each finger, from the palm to the fingertip.
/// @throws InputError  if a finger joint is constrained by anything but a linear relation to
///     another joint of the same finger. Rejected are nonlinear constraints, fixed angles,
///     constraints of three joints, and constraints across fingers or to joints outside the
///     fingers. Also rejected are closed loops (connect, weld), spatial tendons with an actuator or
///     an equality, tendons with a range, and `<mimic>` of an unknown joint. The message names the
///     model's file and the joints.
[[nodiscard]] std::vector<JointRelation> ReadJointRelations(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers);

}  // namespace regrasp::kinematics
