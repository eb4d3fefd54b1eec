#pragma once

#include <vector>

#include "planner/plan/plan.h"

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

}  // namespace regrasp::sim
