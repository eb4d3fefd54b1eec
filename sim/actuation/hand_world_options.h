#pragma once

#include <vector>

#include "planner/kinematics/hand_model.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// Options of the world of a hand, in any engine.
struct HandWorldOptions {
  double mu = 0;
  double mass_kg = 0;
  double gravity_m_s2 = 9.81;  ///< gravity, opposite to the hand's up direction
  double force_factor = 1;     ///< factor on the model's limits of all actuators
  HandPhysics physics = {};
  /// Errors of the hand's joint sensors, by finger: measured minus true angles of the independent
  /// joints, radians. Empty: no errors.
  std::vector<kinematics::JointConfiguration> joint_offsets = {};
  TipShape tip = TipShape::kBall;
};

}  // namespace regrasp::sim
