#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/collision/shape_contact.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/finger_path.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

// A plan keeps each contact at a fixed point of the object. A fingertip sphere that does not slip
// rolls instead, by up to its radius times the rotation angle of the object. These functions
// compute the rolled contacts and the resulting joint configurations.

/// Return the orientation of the fingertip in the object's frame.
/// @param pose  object pose in the palm's frame.
[[nodiscard]] Eigen::Matrix3d FingertipOrientation(const kinematics::Finger& finger,
                                                   const JointConfiguration& configuration,
                                                   const Eigen::Isometry3d& pose);

/// Compute the contact of a fingertip sphere after rolling without slipping.
/// First-order model: the centre moves by the rotation vector times the vector from the contact to
/// the centre, and the new contact is the nearest surface point. Spin about the normal does not
/// move the contact.
/// @param turn  rotation of the fingertip in the object's frame.
/// @param radius  radius of the fingertip, metres.
/// @param surface  surface of the object.
/// @returns the new contact; the old one if no surface is within two radii.
[[nodiscard]] SurfacePoint Rolled(const SurfacePoint& contact, const Eigen::Matrix3d& turn,
                                  double radius, const collision::BallContact& surface);

/// A holding fingertip after rolling.
struct RolledTip {
  SurfacePoint contact;
  JointConfiguration configuration;
};
/// Assumed grasp force (sum of normal forces) relative to the object's weight.
inline constexpr double kGraspForceOverWeight = 12;

/// Rolled fingertip [finger]; none for idle fingers.
using RolledTips = std::vector<std::optional<RolledTip>>;

/// Rolling model of the fingertips of a setup.
class RollingTips {
 public:
  RollingTips(const HandSetup& setup, criteria::GraspMemory& memory)
      : setup_(setup), memory_(memory) {}

  /// Return whether the rolled grasp is admitted by the memory and withstands the object's weight.
  /// With a grasp force of kGraspForceOverWeight times the weight, the force margin
  /// (grasp::GraspForces::margin), which the controller of a hand uses, must reach the setup's.
  [[nodiscard]] bool AreGrasp(const RolledTips& tips, const Eigen::Isometry3d& pose) const;
  /// Roll the fingertips while the object moves to a nearby pose.
  /// @param stance  stance with the configurations of idle fingers.
  /// @returns the rolled fingertips; nullopt if a finger cannot follow, a collision occurs, or the
  ///     grasp is lost.
  [[nodiscard]] std::optional<RolledTips> Advance(const RolledTips& from,
                                                  const Eigen::Isometry3d& from_pose,
                                                  const Eigen::Isometry3d& to_pose,
                                                  const Stance& stance) const;

 private:
  [[nodiscard]] std::optional<RolledTip> Follow(FingerIndex finger, const RolledTip& tip,
                                                const Eigen::Isometry3d& from_pose,
                                                const Eigen::Isometry3d& to_pose) const;
  [[nodiscard]] bool AreClear(const RolledTips& tips, const Eigen::Isometry3d& pose,
                              const Stance& stance) const;

  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
};

/// Add the rolled configurations of the other fingers to a scene.
/// @param tips  rolled fingertips; empty: nothing is added.
void AddRolled(const HandScene& scene, const RolledTips& tips, Surroundings& around);

}  // namespace regrasp::gait
