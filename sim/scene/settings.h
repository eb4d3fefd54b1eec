#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::sim {

/// Responses of the fingers to the disturbance test of a static grasp, and the response that
/// decides.
enum class Protocol {
  kAdapted,  ///< forces planned for each direction: can the grasp resist?
  /// Constant forces of the static grasp and the servos' stiffness: does this grasp force resist?.
  kFixed,
  kBoth,  ///< both, from the same static grasp; the adapted response decides
};

/// Physics engine of a replay by points (sim/scene/engine.h).
enum class EngineChoice {
  kMujoco,  ///< soft contacts and elliptic cones (sim/scene/mujoco_engine.h)
  kOde,     ///< hard contacts and circular cones (sim/ode/ode_engine.h)
  kBoth,    ///< both, one after the other; MuJoCo decides
};

/// Preferred execution of sliding steps in the replay (sim/scene/align_script.h).
enum class AlignChoice {
  kImitate,  ///< finger handovers with free fingers
  kSlide,    ///< fingers slide while the others alone hold the object
};

/// Source of the grasp force.
enum class SqueezeSource {
  kShake,  ///< the weight is a tenth of the disturbance force (scaling.h)
  kHand,   ///< grasp force of a hand (HandSqueeze, scaling.h)
  kGiven,
  kTorques,  ///< limited by the torques of a hand (sim/actuation/torque_squeeze.h)
};

/// Options of the replay. Omitted values are derived from the object (sim/scene/scaling.h).
struct ReplayOptions {
  std::optional<double> half_angle;  ///< friction angle, radians; default: that of the plan
  std::optional<double> mass_kg;     ///< replaces the density
  double density_kg_m3 = 1000;       ///< density ρ of the homogeneous solid
  std::optional<double> thickness;   ///< thickness of a polygon's prism, in the object's own units
  /// Radius of the fingertip spheres, in the object's own units; derived if neither this nor the
  /// plan sets it.
  std::optional<double> finger_radius;
  std::optional<double> squeeze_N;  ///< total normal force of a static grasp
  /// Whether an omitted `squeeze_N` is that of a hand (HandSqueeze) instead of one for the
  /// disturbance test.
  bool hand_squeeze = false;
  /// Disturbance size ρ: force over grasp force, and torque over grasp force · R.
  double shake = 0.01;
  Protocol protocol = Protocol::kAdapted;
  /// Whether to search for the resisted wrench in each direction (sim/measure/shake.h).
  bool stress = false;
  double tolerance = 1e-3;  ///< limit of (|Δx| + R|Δrotation|) / D, and of slip / D
  AlignChoice align = AlignChoice::kImitate;
  double stiffness_factor = 1;  ///< factor of the derived finger stiffness
  double timestep_factor = 1;   ///< factor of the derived time step
  double friction_factor = 1;   ///< simulated friction over the assumed friction
  double mass_factor = 1;       ///< simulated mass of the object over the assumed mass
  EngineChoice engine = EngineChoice::kMujoco;
  /// 9.81 m/s² along −z of the object's own frame; none for a planar object, whose weight the plane
  /// supports.
  bool gravity = true;
};

/// Geometry of a fingertip that touches the object in a replay with a hand.
enum class TipShape {
  kBall,      ///< sphere of the hand file, for which plans are made
  kGeometry,  ///< collision geometry of the hand model at the fingertip
};

/// Limits of a replay with a hand.
struct HandTolerance {
  double length_m = 2e-3;     ///< distance of the object's centroid from its planned position
  double angle_rad = 0.0873;  ///< deviation of its orientation: 5°
  double at_rest = 0.5;       ///< share of both that is allowed in hold phases
  double slip_m = 1e-3;       ///< slip of a fingertip in contact along the surface
  double lost_s = 0.02;       ///< time of a fingertip in contact without a force
  double limit_s = 0.05;      ///< time of an actuator at the limit of its force
  double joint_rad = 0.0175;  ///< angle of a joint outside its range, or off its coupling: 1°
  double depth_m = 5e-4;      ///< penetration depth of a fingertip in the object
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

/// Additional settings of a replay with a hand.
struct HandReplaySettings {
  HandTolerance tolerance;
  /// Whether the measured deviation of the object corrects the joint targets.
  bool feedback = true;
  TipShape tip = TipShape::kBall;
  double least_stiffness = 0;    ///< smallest stiffness of the joint servos, N m / rad
  double largest_stiffness = 0;  ///< largest stiffness of the joint servos, N m / rad
  /// Whether actuators of the model that are not servos were converted to servos.
  bool derived_servos = false;
  std::vector<DriveLimits> limits = {};  ///< limits by finger and independent joint
};

/// Values with which the replay ran.
struct ReplaySettings {
  double mu = 0;
  /// Torsional friction length of all contacts (grasp::Contact::torsion); 0: hard-finger contacts.
  double torsion_m = 0;
  double mass_kg = 0;
  double squeeze_N = 0;
  SqueezeSource squeeze_source = SqueezeSource::kShake;
  double shake = 0;
  EngineChoice engine = EngineChoice::kMujoco;
  Protocol protocol = Protocol::kAdapted;
  bool stress = false;
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
  double natural_time_s = 0;
  double friction_factor = 1;    ///< simulated friction over `mu`
  double mass_factor = 1;        ///< simulated mass of the object over `mass_kg`
  double patch_size_m = 0;       ///< half the side of a contact patch
  double patch_thickness_m = 0;  ///< thickness of the prism under a contact patch
  /// Settings of a replay with a hand; members that apply only to ideal fingers are then 0.
  std::optional<HandReplaySettings> hand = std::nullopt;
};

}  // namespace regrasp::sim
