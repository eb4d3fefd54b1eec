#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "planner/collision/shape_contact.h"

namespace regrasp::sim {

// How hard tips and object touch in MuJoCo, in the replay by a hand and in its exported scene.

/// In which a contact comes back, seconds (solref): five steps of the replay; damped critically.
inline constexpr double kTipContactTime = 5e-3;
/// Impedances, the depth over which the one becomes the other, metres, and the shape (solimp).
inline constexpr std::array<double, 5> kTipImpedance = {0.95, 0.99, 0.0001, 0.5, 2};

/// Return the engine's contact of a tip and the object, without geoms.
/// @param touching  In the object's frame. @param pose  Of the object in the engine's world.
[[nodiscard]] mjContact MakeTipContact(const collision::SurfaceContact& touching,
                                       const Eigen::Isometry3d& pose, double mu);

/// The contacts of a tip as one, in the engine's world.
struct ContactSum {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the object
  double pressing = 0;                               ///< sum of the normal forces
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the surface, times `pressing`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward, times `pressing`
};
[[nodiscard]] ContactSum SumTipContacts(const mjModel& model, const mjData& data, int object_geom,
                                        int tip_geom);

}  // namespace regrasp::sim
