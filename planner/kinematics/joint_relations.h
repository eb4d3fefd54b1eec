#pragma once

#include <string>
#include <vector>

namespace regrasp::kinematics {

struct CompiledModel;

/// A linear relation that a model imposes on the angles of two joints of one finger, radians:
/// angle of `joint` = ratio · angle of `leader` + offset.
struct JointRelation {
  int joint = 0;   ///< joint of the model, different from `leader`
  int leader = 0;  ///< joint of the model that the relation names as the independent one
  double ratio = 1;
  double offset = 0;
  /// Whether only the sum of the angles is imposed, by a fixed tendon that one actuator pulls. The
  /// ratio is then that of the tendon's coefficients, which the real hand need not keep.
  bool shares_actuator = false;
  std::string source;  ///< element that imposes it, for messages: "<mimic> of joint ff2"
};

/// Return all relations that a model imposes on the joints of its fingers.
///
/// The sources are active equality constraints of joints and of fixed tendons, URDF `<mimic>`
/// elements, and fixed tendons with an actuator. Constraints that involve no joint of a finger are
/// skipped. A constraint on angles beyond the reference position is converted to angles.
/// @param fingers  joints of each finger, from the palm to the tip.
/// @throws InputError  a finger has a joint that does not move as one joint of the finger commands:
///                     a constraint that is not linear, holds a joint at an angle, involves three
///                     joints, two fingers or a joint outside the fingers; a closed loop (connect,
///                     weld); a spatial tendon with an actuator or an equality; a tendon with a
///                     range; a `<mimic>` of an unknown joint. The message names the model's file
///                     and the joints.
[[nodiscard]] std::vector<JointRelation> ReadJointRelations(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers);

}  // namespace regrasp::kinematics
