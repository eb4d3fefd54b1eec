#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::sim {

/// How the fingers respond to the shake at a rest, and which response decides.
enum class Protocol {
  kAdapted,  ///< with forces planned for each direction: can the grasp resist?
  kFixed,    ///< with the forces of the rest and the servos' stiffness: does this squeeze?
  kBoth,     ///< both, from the same rest; the adapted one decides
};

/// The physics engine that a replay by points runs in (sim/scene/engine.h).
enum class EngineChoice {
  kMujoco,  ///< soft contacts and elliptic cones (sim/scene/mujoco_engine.h)
  kOde,     ///< hard contacts and circular cones (sim/ode/ode_engine.h)
  kBoth,    ///< both, one after the other; MuJoCo decides
};

/// How the replay moves fingers along the surface where it can choose (sim/scene/align_script.h).
enum class AlignChoice {
  kImitate,  ///< spare fingers take over
  kSlide,    ///< fingers slide while the others alone hold the object
};

/// Where the squeeze comes from.
enum class SqueezeSource {
  kShake,  ///< such that the weight is a tenth of the shake (scaling.h)
  kHand,   ///< what a hand applies (hand_squeeze.h)
  kGiven,
  kTorques,  ///< what the torques of a hand allow (sim/actuation/torque_squeeze.h)
};

/// How the replay is set up. What is left out is derived from the body (sim/scene/scaling.h).
struct ReplayOptions {
  std::optional<double> half_angle;  ///< friction, radians; the plan's where left out
  std::optional<double> mass_kg;     ///< instead of density
  double density_kg_m3 = 1000;       ///< ρ of the homogeneous solid
  std::optional<double> thickness;   ///< of a polygon's prism, in the object's own units
  /// Fingertips are balls of this radius, in the object's own units; derived where neither this nor
  /// the plan says.
  std::optional<double> finger_radius;
  std::optional<double> squeeze_N;  ///< total normal force of a grasp at rest
  /// Where `squeeze_N` is left out: that of a hand (hand_squeeze.h) instead of one for the shake.
  bool hand_squeeze = false;
  double shake = 0.01;  ///< ρ: shake force over squeeze, and torque over squeeze·R
  Protocol protocol = Protocol::kAdapted;
  bool stress = false;  ///< also look for the largest push in each direction (sim/measure/shake.h)
  double tolerance = 1e-3;  ///< allowed (|Δx| + R|Δrotation|) / D, and slip / D
  AlignChoice align = AlignChoice::kImitate;
  double stiffness_factor = 1;  ///< of the fingers, times what is derived
  double timestep_factor = 1;   ///< times what is derived
  double friction_factor = 1;   ///< the world's friction over the one that the hand believes
  double mass_factor = 1;       ///< the object's true mass over the one that the hand believes
  EngineChoice engine = EngineChoice::kMujoco;
  bool gravity = true;  ///< 9.81 m/s² along −z of the object's own frame; none of
                        ///< it in the plane, which carries a planar object's weight
};

/// What of a fingertip touches the object in a replay by a hand.
enum class TipShape {
  kBall,      ///< of the hand's file, which plans are made for
  kGeometry,  ///< what the hand's own model has at the tip for collisions
};

/// What a replay by a hand may be off.
struct HandTolerance {
  double length_m = 2e-3;     ///< of the object's centroid from its planned place
  double angle_rad = 0.0873;  ///< of its orientation: 5°
  double at_rest = 0.5;       ///< share of both that is allowed at rest
  double slip_m = 1e-3;       ///< of a holding tip along the surface
  double lost_s = 0.02;       ///< of a holding tip without a force
  double limit_s = 0.05;      ///< of an actuator at the limit of its force
  double joint_rad = 0.0175;  ///< of a joint outside its range, or off its coupling: 1°
  double depth_m = 5e-4;      ///< of a fingertip in the object
};

/// The limits of the hand's model that a verdict relies on, for one independent joint.
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

/// What a replay by a hand ran with beside the rest.
struct HandReplaySettings {
  HandTolerance tolerance;
  bool feedback = true;  ///< joint targets are corrected by the object's measured offset
  TipShape tip = TipShape::kBall;
  double least_stiffness = 0;    ///< of the servos of joints, N m / rad
  double largest_stiffness = 0;  ///< the same
  bool derived_servos = false;   ///< some actuators of the model are no servos: they are made so
  std::vector<DriveLimits> limits = {};  ///< by finger and independent joint
};

/// The values that the replay ran with.
struct ReplaySettings {
  double mu = 0;
  double torsion_m = 0;  ///< of all contacts (grasp::Contact::torsion); 0: hard points
  double mass_kg = 0;
  double squeeze_N = 0;
  SqueezeSource squeeze_source = SqueezeSource::kShake;
  double shake = 0;
  EngineChoice engine = EngineChoice::kMujoco;
  Protocol protocol = Protocol::kAdapted;
  bool stress = false;
  double tolerance = 0;
  AlignChoice align = AlignChoice::kImitate;
  double gravity_m_s2 = 0;  ///< 0 for a planar object: the plane carries it
  double thickness_m = 0;   ///< of the prism of a planar object, 0 for a solid
  double diameter_m = 0;    ///< D, the object's; R is half of it
  double fingertip_radius_m = 0;
  double finger_mass_kg = 0;
  double finger_stiffness_N_m = 0;
  double finger_damping_Ns_m = 0;
  double timestep_s = 0;
  double natural_time_s = 0;     ///< √(M D / F): what durations of the replay are counted in
  double friction_factor = 1;    ///< the world's friction over `mu`
  double mass_factor = 1;        ///< the object's true mass over `mass_kg`
  double patch_size_m = 0;       ///< half the side of a contact patch
  double patch_thickness_m = 0;  ///< of the prism under a contact patch
  /// Of a replay by a hand; what is of ideal fingers alone is then 0.
  std::optional<HandReplaySettings> hand = std::nullopt;
};

}  // namespace regrasp::sim
