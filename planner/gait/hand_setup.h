#pragma once

#include <vector>

#include "planner/collision/ball_contact.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/reach_map.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::gait {

/// A hand ready to work with an object: its inverse kinematics, and points of the surface.
struct HandSetup {
  const HandScene& scene;
  const std::vector<kinematics::InverseKinematics>& inverse;  ///< by finger
  const std::vector<SurfacePoint>& points;
  double scale = 1;  ///< metres per unit of the object's file
  /// For gaits with reserve: grasps hold where their contacts have rolled to on this surface. Null:
  /// contacts count as they are planned.
  const collision::BallContact* rolled_on = nullptr;
  /// Where contacts roll: what forces that hold the object's weight have to spare (RollingTips).
  double force_margin = 0;
  bool may_slide = true;          ///< fingers that hold
  int fewest_beside_sliding = 0;  ///< that hold and stay, while others slide
};

/// By finger: postures in which it may wait while it holds nothing, the best first.
using Parking = std::vector<std::vector<Posture>>;

}  // namespace regrasp::gait
