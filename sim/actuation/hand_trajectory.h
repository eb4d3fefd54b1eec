#pragma once

#include <string>
#include <vector>

#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// Recorded motion of a hand during a replay, in formats that other programs read.
class HandTrajectory {
 public:
  /// Record a state every kInterval. Call it after every step of the world.
  void Add(const HandWorld& world);

  /// Format the motion as CSV: a header row, then a row per time sample.
  ///
  /// - time_s
  /// - angles of all joints of the fingers, rad, with the joint names of the model
  /// - controls of the model's actuators (`control NAME`)
  /// - the object's origin (m) and quaternion w, x, y, z in the palm's frame
  ///
  /// Lines end with CR LF.
  [[nodiscard]] std::string FormatCsv() const;
  /// Format the motion as NPZ arrays.
  /// They are time_s (N), joints (N, J), controls (N, C), object (N, 7), and the names joint_names
  /// (J) and control_names (C).
  [[nodiscard]] std::string FormatNpz() const;

  /// interval of the samples, seconds; that of the controller's measurements
  inline static constexpr double kInterval = 0.01;

 private:
  struct Sample {
    double time_s = 0;
    std::vector<double> joints, controls, object;
  };
  std::vector<std::string> joint_names_;
  std::vector<std::string> control_names_;
  std::vector<Sample> samples_;
};

}  // namespace regrasp::sim
