#pragma once

#include <vector>

#include "sim/actuation/hand_scene.h"
#include "sim/actuation/link_tree.h"

namespace regrasp::sim {

/// The passive dynamics and the servo of one joint of a finger, from the hand's model.
///
/// The torque about the joint is linear in the speed w of the joint at the end of a time step h, as
/// long as the actuator is within its limit:
///
///     τ(w) = I (w₀ − w)/h − d w − k (q + h w − s) + m f(w)
///
/// with the armature I, the damping d and the stiffness k of the joint, and the force f of the
/// actuator with the moment m. All terms are implicit, so that neither a stiff servo nor a light
/// link limits the time step.
struct JointDrive {
  double armature = 0;   ///< kg m²
  double damping = 0;    ///< N m s/rad
  double stiffness = 0;  ///< N m/rad
  double spring = 0;     ///< angle at which the stiffness exerts no torque, radians
  double friction = 0;   ///< largest torque of dry friction, N m
  bool is_limited = false;
  double lower = 0, upper = 0;  ///< range if it is limited, radians
  // The actuator: force = gain · control + constant + per_angle · q + per_speed · w, clamped.
  // Joints that follow another one have none, and no range.
  int actuator = -1;  ///< index in the model; −1: none
  double moment = 0;  ///< torque per force
  double gain = 0, constant = 0, per_angle = 0, per_speed = 0;
  bool is_force_limited = false;
  double least_force = 0, largest_force = 0;

  /// State of the joint at the start of a time step, and the control of the actuator.
  struct Input {
    double angle = 0, speed = 0, control = 0, timestep = 0;
  };
  /// Torque τ(w) = `offset` − `slope` · w of a joint; positive slope.
  struct Law {
    double slope = 0, offset = 0;
  };
  /// Return the law with the force of the actuator as given, or as its servo exerts it.
  /// @param saturated  −1 or 1: the actuator is at its least or largest force.
  [[nodiscard]] Law LawFor(const Input& input, int saturated) const;
  /// Return the force of the actuator without its limits.
  /// @param speed  speed of the joint at the end of the time step.
  [[nodiscard]] double FreeForce(const Input& input, double speed) const;
  /// Return the limited force.
  [[nodiscard]] double Force(const Input& input, double speed) const;
  /// Return −1 or 1 if the actuator is at its least or largest force, otherwise 0.
  [[nodiscard]] int Saturation(const Input& input, double speed) const;
};

/// Return the drives of all joints of a tree's links, in their order.
/// @throws InputError  if the model has tendons with forces, or actuators that do not act on one
///     independent joint.
[[nodiscard]] std::vector<JointDrive> JointDrivesOf(const HandScene& scene, const LinkTree& tree);

}  // namespace regrasp::sim
