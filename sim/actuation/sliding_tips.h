#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// A timed path of a hand, with zero speed at both ends.
/// Between two states it is as fast as the speed limits of joints and object allow.
class TimedPath {
 public:
  /// @param path         path with at least one state; must outlive this object.
  /// @param joint_speed  speed limit of each joint, rad/s.
  TimedPath(const plan::HandPath& path, double joint_speed);

  [[nodiscard]] double duration() const;
  /// @param time  seconds since the start of the path; clamped to its duration.
  [[nodiscard]] plan::HandState At(double time) const;

 private:
  const plan::HandPath& path_;
  std::vector<double> times_;  ///< times of the states, at full speed
};

inline constexpr double kObjectSpeed = 0.03;  ///< m/s
inline constexpr double kObjectTurn = 0.5;    ///< rad/s
inline constexpr double kHeldJoints = 0.7;  ///< speed limit of fingers that hold the object, rad/s
inline constexpr double kFreeJoints = 1.5;  ///< rad/s
inline constexpr double kPathRamp = 0.15;   ///< time from zero to full speed, s

/// Return the planned centre of a fingertip sphere, in the object's frame, metres.
[[nodiscard]] Eigen::Vector3d PlannedTip(const kinematics::HandModel& hand,
                                         const plan::HandState& state, FingerIndex finger);

/// Paths of sliding fingertips between two waypoints of a sliding step.
/// They lead from the actual places of the fingertips to the planned ones.
class SlidingTips {
 public:
  /// @param control   controller, which measures the present places of the fingertips.
  /// @param timed     path between the two waypoints; must outlive this object.
  /// @param from, to  waypoints; fingers slide if their contacts differ.
  SlidingTips(const HandControl& control, const kinematics::HandModel& hand, const TimedPath& timed,
              const plan::FingerGrasp& from, const plan::FingerGrasp& to);

  /// Return whether no finger slides.
  [[nodiscard]] bool empty() const { return tips_.empty(); }
  [[nodiscard]] double duration() const { return duration_; }  ///< seconds
  /// @param share  elapsed share of the time.
  [[nodiscard]] plan::HandState StateAt(double share) const;
  /// Return the target of a sliding fingertip sphere's centre, in the object's frame, metres.
  /// The initial offset from the planned path decreases linearly.
  [[nodiscard]] Eigen::Vector3d CentreAt(FingerIndex finger, double share) const;
  /// Return the sliding fingers and their directions.
  [[nodiscard]] std::vector<SlidingFinger> At(double share) const;

 private:
  struct Tip {
    FingerIndex finger;
    Eigen::Vector3d off_O;  ///< initial offset from the path
  };
  const kinematics::HandModel& hand_;
  const TimedPath& timed_;
  std::vector<Tip> tips_;
  double duration_ = 0;
};

}  // namespace regrasp::sim
