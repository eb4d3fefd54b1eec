#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/collision/ball_contact.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

// A plan's contacts stay where they are on the object; those of balls that do not slip roll, by up
// to the ball's radius times the angle that the object turns by. What a gait with reserve comes to
// then is followed here: where its contacts are, and how its fingers stand there.

/// How a fingertip's ball is turned, seen from the object.
/// @param pose  of the object in the palm's frame.
[[nodiscard]] Eigen::Matrix3d FingertipOrientation(const kinematics::Finger& finger,
                                                   const Posture& posture,
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

/// A fingertip that holds, where it has rolled to.
struct RolledTip {
  SurfacePoint contact;
  Posture posture;
};
/// The sum of the normal forces of a grasp over the object's weight, as hands usually squeeze.
inline constexpr double kGraspForceOverWeight = 12;

/// By finger; none where it holds nothing.
using RolledTips = std::vector<std::optional<RolledTip>>;

/// Follows how tips roll on the surface of a setup for gaits with reserve.
class RollingTips {
 public:
  RollingTips(const HandSetup& setup, criteria::GraspMemory& memory)
      : setup_(setup), memory_(memory) {}

  /// Whether the grasp where they are is one that the memory admits, and fingers that push with
  /// kSqueeze times the object's weight can hold it there with the setup's margin inside the cones
  /// (grasp::GraspForces::margin): what the controller of a hand goes by.
  [[nodiscard]] bool AreGrasp(const RolledTips& tips, const Eigen::Isometry3d& pose) const;
  /// Where they are when the object goes to a pose near by.
  /// @param hold  whose other fingers wait.
  /// @returns nullopt where a finger can't follow, something runs into something, or the grasp is
  /// lost.
  [[nodiscard]] std::optional<RolledTips> Carry(const RolledTips& from,
                                                const Eigen::Isometry3d& from_pose,
                                                const Eigen::Isometry3d& to_pose,
                                                const Stance& hold) const;

 private:
  [[nodiscard]] std::optional<RolledTip> Follow(FingerIndex finger, const RolledTip& tip,
                                                const Eigen::Isometry3d& from_pose,
                                                const Eigen::Isometry3d& to_pose) const;
  [[nodiscard]] bool AreClear(const RolledTips& tips, const Eigen::Isometry3d& pose,
                              const Stance& hold) const;

  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
};

/// Adds the other fingers where they have rolled to. @param tips  empty: nothing has rolled.
void AddRolled(const HandScene& scene, const RolledTips& tips, Surroundings& around);

}  // namespace regrasp::gait
