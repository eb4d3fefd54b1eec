#pragma once

#include <Eigen/Geometry>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/load_resistance.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Decides whether fingers hold an object by its weight.
///
/// A grasp is *gravity-supported* if it balances the weight and every disturbance of a given size
/// with bounded forces (grasp::BoundLoadResistance). It need not be force closure: fingers below an
/// object hold it as a table does. Such a grasp depends on the direction of gravity in the object's
/// frame, and therefore on the object's pose.
///
/// Laws: those of BoundLoadResistance. A rotation of the object about the direction of gravity,
/// together with its contacts, changes nothing.
class WeightCarrier {
 public:
  /// @param friction_angle  friction angle in radians.
  /// @param up  unit vector against gravity in the palm's frame.
  WeightCarrier(const object::WrenchFrame& frame, double friction_angle,
                const GravitySupport& support, const Eigen::Vector3d& up)
      : frame_(frame), friction_angle_(friction_angle), support_(support), up_(up) {}

  [[nodiscard]] const GravitySupport& support() const { return support_; }

  /// Return bounds on the size of the disturbances that a grasp resists, in weights.
  /// @param pose  object pose in the palm's frame.
  [[nodiscard]] grasp::LoadResistance ResistanceAt(std::span<const grasp::Contact> contacts,
                                                   const Eigen::Isometry3d& pose) const;
  /// Return whether a grasp is certainly gravity-supported at a pose.
  [[nodiscard]] bool HoldsAt(std::span<const grasp::Contact> contacts,
                             const Eigen::Isometry3d& pose) const {
    return ResistsAt(contacts, pose, support_.disturbance, friction_angle_);
  }
  /// Return whether a grasp is certainly gravity-supported while the object moves from one pose to
  /// another, rotating about one axis.
  ///
  /// The set of loads that a grasp resists is convex, so the margins at both ends hold on the chord
  /// between their loads. During a rotation by θ the load is at most 1 − cos(θ/2) weights from the
  /// chord. Both ends must resist that much more.
  [[nodiscard]] bool HoldsBetween(std::span<const grasp::Contact> contacts,
                                  const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  /// Return whether a grasp is certainly gravity-supported at all poses of a path, with
  /// HoldsBetween for consecutive poses.
  /// @param poses  at least one pose.
  [[nodiscard]] bool HoldsAlong(std::span<const grasp::Contact> contacts,
                                std::span<const Eigen::Isometry3d> poses) const;
  /// Return the smallest friction angle at which a grasp is gravity-supported at a pose.
  /// @pre HoldsAt the pose.
  [[nodiscard]] grasp::RequiredFrictionAngle RequiredFrictionAngleAt(
      std::span<const grasp::Contact> contacts, const Eigen::Isometry3d& pose) const;

 private:
  [[nodiscard]] bool ResistsAt(std::span<const grasp::Contact> contacts,
                               const Eigen::Isometry3d& pose, double disturbance,
                               double friction_angle) const;
  [[nodiscard]] grasp::Wrench WeightAt(const Eigen::Isometry3d& pose) const;

  object::WrenchFrame frame_;
  double friction_angle_;
  GravitySupport support_;
  Eigen::Vector3d up_;
};

}  // namespace regrasp::plan
