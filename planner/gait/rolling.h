#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/collision/ball_contact.h"
#include "planner/gait/reach_map.h"

namespace regrasp::gait {

// A plan's contacts stay where they are on the object; those of balls that do not slip roll. How
// far, a gait with reserve takes into account.

/// By finger: where its contact has rolled to; none where it holds nothing.
using RolledContacts = std::vector<std::optional<SurfacePoint>>;

/// How a fingertip's ball is turned, seen from the object.
/// @param pose  of the object in the palm's frame.
[[nodiscard]] Eigen::Matrix3d BallIn(const kinematics::Finger& finger, const Posture& posture,
                                     const Eigen::Isometry3d& pose);

/// Where a ball touches after it has rolled without slipping: its centre goes by the rotation
/// vector times the way from the contact to the centre, and touches what is nearest then. Of first
/// order in the turn; spinning about the normal goes nowhere.
/// @param turn     of the ball, in the object's frame.
/// @param radius   of the ball, metres.
/// @param surface  of the object.
/// @returns the new contact; the old one where no surface is near.
[[nodiscard]] SurfacePoint Rolled(const SurfacePoint& contact, const Eigen::Matrix3d& turn,
                                  double radius, const collision::BallContact& surface);

}  // namespace regrasp::gait
