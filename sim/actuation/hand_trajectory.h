#pragma once

#include <string>
#include <vector>

#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// What a hand does during a replay, as other programs read it.
class HandTrajectory {
 public:
  /// To be called after every step of the world; keeps one every kInterval.
  void Add(const HandWorld& world);

  /// A header row, then a row per instant: time_s, the angles of all joints of the fingers (rad,
  /// named as the model names them), the controls of the model's actuators (`control NAME`), the
  /// object's origin (m) and quaternion w, x, y, z in the palm's frame. Lines end with CR LF.
  [[nodiscard]] std::string FormatCsv() const;
  /// The same as arrays: time_s (N), joints (N, J), controls (N, C), object (N, 7), and the names
  /// joint_names (J) and control_names (C).
  [[nodiscard]] std::string FormatNpz() const;

  inline static constexpr double kInterval = 0.01;  ///< seconds, of the controller's measurements

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
