#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
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
  std::uint64_t seed = 0;  ///< seed of all errors

  bool operator==(const HandSensing&) const = default;
};

/// Model of the contact between a fingertip and the object.
enum class TipContactModel {
  kStiff,    ///< contact model of the replay (docs/hand_replay.md)
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

/// Response of the fingers to the disturbance test, and the response that decides.
enum class Protocol {
  kAdapted,  ///< forces planned for each direction
  kFixed,    ///< the forces of the static grasp and the stiffness of the servos
  kBoth,     ///< both, from the same static grasp; the adapted one decides
};

/// Physics engine of a replay (sim/scene/engine.h; by a hand: sim/actuation/hand_engine.h).
enum class EngineChoice {
  kMujoco,  ///< soft contacts and elliptic cones (sim/scene/mujoco_engine.h)
  kOde,     ///< hard contacts and circular cones (sim/ode/ode_engine.h)
  kBoth,    ///< both, one after the other; MuJoCo decides
};

/// Execution of sliding steps if both are possible (sim/scene/align_script.h).
enum class AlignChoice {
  kImitate,  ///< finger handovers with free fingers
  kSlide,    ///< fingers slide while the others alone hold the object
};

/// Source of the grasp force.
enum class GraspForceSource {
  kDisturbance,  ///< the weight is a tenth of the disturbance force (scaling.h)
  kHand,         ///< the force of a human hand (hand_grasp_force.h)
  kGiven,        ///< ReplayConditions::grasp_force_N
  kTorques,      ///< the torque limits of the hand (sim/actuation/torque_grasp_force.h)
};

/// Options of every replay: the object's mass, the grasp force and the disturbance test. Optional
/// values without a value are derived from the object, the grasps or the hand.
struct ReplayConditions {
  std::optional<double> mass_kg;        ///< mass of the object, instead of density
  std::optional<double> density_kg_m3;  ///< density of the homogeneous solid; default: of the plan
  std::optional<double> thickness;      ///< thickness of a polygon's prism, unit of the object
  std::optional<double> grasp_force_N;  ///< grasp force: sum of the normal forces of a static grasp
  double disturbance_ratio = 0.01;  ///< ρ: disturbance force over grasp force; a torque also over R
  double friction_factor = 1;       ///< friction of the world over the one that the hand assumes
  double mass_factor = 1;           ///< mass of the object over the one that the hand assumes
};

/// Options of a replay by point fingers. The friction is the plan's. Optional values without a
/// value are derived from the object (sim/scene/scaling.h).
struct ReplayOptions : ReplayConditions {
  /// Radius of the spherical fingertips, unit of the object; default: the plan's, if it has one.
  std::optional<double> finger_radius;
  /// Whether a derived grasp force is that of a human hand (hand_grasp_force.h).
  bool hand_grasp_force = false;
  Protocol protocol = Protocol::kAdapted;
  bool resisted_wrench =
      false;  ///< measure the resisted wrench in each direction (sim/measure/disturbance.h)
  double tolerance = 1e-3;  ///< allowed (|Δx| + R|Δrotation|) / D, and slip / D
  AlignChoice align = AlignChoice::kImitate;
  double stiffness_factor = 1;  ///< factor on the derived stiffness of the fingers
  double timestep_factor = 1;   ///< factor on the derived time step
  EngineChoice engine = EngineChoice::kMujoco;
  bool gravity = true;  ///< 9.81 m/s² along −z of the object's frame, except for planar objects
};

/// Geometry of a fingertip that touches the object in a replay by a hand.
enum class TipShape {
  kBall,      ///< the sphere of the hand's file, for which plans are made
  kGeometry,  ///< the collision geometry of the fingertip in the hand's model
};

/// Limits on deviations in a replay by a hand.
struct HandTolerance {
  double length_m = 2e-3;      ///< distance of the object's centroid from the plan
  double angle_rad = 0.0873;   ///< rotation of the object from the plan: 5°
  double at_rest = 0.5;        ///< share of both that is allowed in a static grasp
  double slip_m = 1e-3;        ///< slip of a holding fingertip along the surface
  double lost_s = 0.02;        ///< time of a holding fingertip without a force
  double limit_s = 0.05;       ///< time of an actuator at its force limit
  double joint_rad = 0.0175;   ///< deviation of a joint from its range or coupling: 1°
  double depth_m = 1e-3;       ///< depth of a fingertip in the object
  double frozen_m = 1e-3;      ///< motion of the centroid under constant controls
  double frozen_rad = 0.0437;  ///< rotation of the object under constant controls: 2.5°
};

/// Limits of the hand model for one independent joint, on which a verdict depends.
struct DriveLimits {
  FingerIndex finger = {};
  std::string joint;
  std::string actuator;
  double torque_Nm = std::numeric_limits<double>::infinity();  ///< infinite if the model has none
  /// Range of the actuator's control in the model's units; none if the model has none.
  std::optional<std::array<double, 2>> control = std::nullopt;
  double lower_rad = 0;  ///< range of the joint
  double upper_rad = 0;
};

/// Settings of a replay by a hand in addition to ReplaySettings.
struct HandReplaySettings {
  HandTolerance tolerance;
  HandSensing sensing;
  HandPhysics physics;
  TipShape tip = TipShape::kBall;
  double least_stiffness = 0;    ///< smallest stiffness of the joint servos, N m / rad
  double largest_stiffness = 0;  ///< largest stiffness of the joint servos, N m / rad
  bool derived_servos = false;   ///< whether some actuators were converted to servos
  /// Least stiffness in the hand's model of the servos that the controller stiffens, N m / rad.
  /// None if it stiffens none.
  std::optional<double> soft_stiffness = std::nullopt;
  std::vector<DriveLimits> limits = {};  ///< limits, by finger and independent joint
};

/// Values with which the replay ran.
struct ReplaySettings {
  double mu = 0;
  /// Torsional friction length of all contacts (grasp::Contact::torsion); 0: hard-finger contacts.
  double torsion_m = 0;
  double mass_kg = 0;
  double grasp_force_N = 0;
  GraspForceSource grasp_force_source = GraspForceSource::kDisturbance;
  double disturbance_ratio = 0;
  EngineChoice engine = EngineChoice::kMujoco;
  Protocol protocol = Protocol::kAdapted;
  bool resisted_wrench = false;
  double tolerance = 0;
  AlignChoice align = AlignChoice::kImitate;
  double gravity_m_s2 = 0;  ///< 0 for a planar object, which the plane supports
  double thickness_m = 0;   ///< thickness of the prism of a planar object, 0 for a solid
  double diameter_m = 0;    ///< diameter D of the object; R is half of it
  double fingertip_radius_m = 0;
  double finger_mass_kg = 0;
  double finger_stiffness_N_m = 0;
  double finger_damping_Ns_m = 0;
  double timestep_s = 0;
  /// Characteristic time √(M D / F), the unit of durations of the replay.
  double characteristic_time_s = 0;
  double friction_factor = 1;    ///< simulated friction over `mu`
  double mass_factor = 1;        ///< simulated mass of the object over `mass_kg`
  double patch_size_m = 0;       ///< half the side of a contact patch
  double patch_thickness_m = 0;  ///< thickness of the prism under a contact patch
  /// Set for a replay by a hand; values of point fingers are then 0.
  std::optional<HandReplaySettings> hand = std::nullopt;
};

}  // namespace regrasp::sim
