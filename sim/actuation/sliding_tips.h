#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// A path of a hand in time: from rest to rest, as fast between two states as joints and object may
/// go.
class TimedPath {
 public:
  /// @param path         outlives this object; at least one state.
  /// @param joint_speed  of the fastest joint, rad/s.
  TimedPath(const plan::HandPath& path, double joint_speed);

  [[nodiscard]] double duration() const;
  /// @param time  seconds since its begin; before and after it stands.
  [[nodiscard]] plan::HandState At(double time) const;

 private:
  const plan::HandPath& path_;
  std::vector<double> times_;  ///< of the states, at full speed
};

inline constexpr double kObjectSpeed = 0.03;  ///< m/s
inline constexpr double kObjectTurn = 0.5;    ///< rad/s
inline constexpr double kHeldJoints = 0.7;    ///< rad/s, of fingers that carry the object
inline constexpr double kFreeJoints = 1.5;    ///< rad/s
inline constexpr double kPathRamp = 0.15;     ///< s, from rest to full speed

/// Where a state has the centre of a finger's tip, in the object's frame, metres.
[[nodiscard]] Eigen::Vector3d PlannedTip(const kinematics::HandModel& hand,
                                         const plan::HandState& state, FingerIndex finger);

/// How tips slide between two waypoints of an align: from where they are to where they should be.
class SlidingTips {
 public:
  /// @param world     how hand and object are now.
  /// @param timed     the path between the two; outlives this object, as the world does.
  /// @param from, to  the waypoints; fingers slide whose contacts differ.
  SlidingTips(const HandWorld& world, const TimedPath& timed, const plan::FingerGrasp& from,
              const plan::FingerGrasp& to);

  /// Whether no finger slides.
  [[nodiscard]] bool empty() const { return tips_.empty(); }
  [[nodiscard]] double duration() const { return duration_; }  ///< seconds
  /// @param share  of the time.
  [[nodiscard]] plan::HandState StateAt(double share) const;
  /// Where the centre of a sliding finger's tip is to be, in the object's frame, metres: what it is
  /// off its way at first goes evenly.
  [[nodiscard]] Eigen::Vector3d CentreAt(FingerIndex finger, double share) const;
  /// The fingers that slide, and where they go.
  [[nodiscard]] std::vector<SlidingFinger> At(double share) const;

 private:
  struct Tip {
    FingerIndex finger;
    Eigen::Vector3d off_O;  ///< at first
  };
  const kinematics::HandModel& hand_;
  const TimedPath& timed_;
  std::vector<Tip> tips_;
  double duration_ = 0;
};

}  // namespace regrasp::sim
