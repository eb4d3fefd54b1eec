#pragma once

#include <string>

#include "planner/plan/snapshot.h"

namespace regrasp {

/// Collects time, place and force of every finger as CSV, a row for each finger and instant:
///
///     time_s,finger,role,x_m,y_m,z_m,force_x_N,force_y_N,force_z_N
///
/// The place is the fingertip's centre, forces act on the object; both along the axes that the
/// object has at the start. Numbers read back as the same doubles.
class TrajectoryTable {
 public:
  void Add(const Snapshot& snapshot);
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_ = "time_s,finger,role,x_m,y_m,z_m,force_x_N,force_y_N,force_z_N\n";
};

}  // namespace regrasp
