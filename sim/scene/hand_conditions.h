#pragma once

#include <cstdint>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::sim {

/// Measurement of the object's pose by the controller of a hand.
enum class PoseFeedback {
  kPose,  ///< a camera that measures it with delay, noise and bias
  kNone,  ///< nothing: joints and touch only
};

/// Sensors of a hand and of the object's pose, and their errors.
struct HandSensing {
  PoseFeedback feedback = PoseFeedback::kPose;
  double pose_delay_s = 0.05;  ///< age of a measured pose when it arrives
  double pose_rate_Hz = 30;    ///< rate of measured poses
  double pose_noise_m = 3e-4;  ///< standard deviation of the centroid's position along each axis
  double pose_noise_rad = 5.236e-3;  ///< standard deviation of the rotation about each axis: 0.3°
  double pose_bias_m = 0;            ///< standard deviation of the constant error along each axis
  double pose_bias_rad = 0;          ///< standard deviation of the constant error about each axis
  double joint_bias_rad = 0;   ///< standard deviation of the constant error of each joint angle
  double touch_N = 0.05;       ///< smallest contact force that a finger detects
  double command_delay_s = 0;  ///< time from a command of the controller to its effect on a servo
  /// Constant errors of the joint angles, by finger: measured minus true angles of the independent
  /// joints, radians. They are added to errors by `joint_bias_rad`. Empty: none.
  std::vector<kinematics::JointConfiguration> joint_offsets = {};
  std::uint64_t seed = 0;  ///< of all errors

  bool operator==(const HandSensing&) const = default;
};

/// Model of the contact between a fingertip and the object.
enum class TipContactModel {
  kStiff,    ///< that of the replay (docs/hand_replay.md)
  kDefault,  ///< MuJoCo's default `solref` and `solimp`, with `impratio` 10 as in MuJoCo Menagerie
};

/// Physics of a replay by a hand that the controller does not know.
struct HandPhysics {
  double timestep_s = 1e-3;
  bool pyramidal_cones = false;  ///< friction cones are pyramids instead of circular
  TipContactModel contacts = TipContactModel::kStiff;
  double torsion_m = 0;          ///< torsional friction length of a fingertip
  double gain_factor = 1;        ///< true over nominal gain of all actuators
  double joint_friction_Nm = 0;  ///< additional dry friction of all joints

  bool operator==(const HandPhysics&) const = default;
};

}  // namespace regrasp::sim
