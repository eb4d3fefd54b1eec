#pragma once

#include <string>
#include <vector>

#include "planner/plan/projection.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

// Recorded motions of both replays. Lines of CSV end with CR LF (RFC 4180).

/// Format the samples of a replay by point fingers as CSV: a header row with units, then a row per
/// sample and finger.
///
/// Columns: time_s, finger, role, fingertip position (m), contact point (m), inward normal, and
/// force on the object (N), all in the world frame of Snapshot. The path of a free finger between
/// two contacts is up to the hand: its position jumps while its role is "free". Disturbance tests
/// are not part of the motion.
[[nodiscard]] std::string FormatTrajectory(const std::vector<plan::Snapshot>& samples);

/// Records the motion of a hand during a replay for other programs.
class HandTrajectory {
 public:
  /// Record the state after a time step of the world, at most one per kInterval.
  void Add(const HandWorld& world);

  /// Format as CSV: a header row, then a row per sample. Columns: time_s, the angles of all joints
  /// of the fingers (rad, named as in the model), the controls of the model's actuators (`control
  /// NAME`), the object's origin (m) and quaternion w, x, y, z in the palm's frame.
  [[nodiscard]] std::string FormatCsv() const;
  /// Format as NPZ arrays: time_s (N), joints (N, J), controls (N, C), object (N, 7), and the names
  /// joint_names (J) and control_names (C).
  [[nodiscard]] std::string FormatNpz() const;

  inline static constexpr double kInterval = 0.01;  ///< period of the controller, seconds

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
