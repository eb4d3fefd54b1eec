#include "sim/replay/trajectory.h"

#include "planner/base/number.h"

namespace regrasp::sim {
namespace {

const char* RoleName(plan::FingerRole role) {
  switch (role) {
    case plan::FingerRole::kFree:
      return "free";
    case plan::FingerRole::kHolding:
      return "holding";
    case plan::FingerRole::kPlaced:
      return "placed";
    case plan::FingerRole::kReleased:
      return "released";
    case plan::FingerRole::kMoved:
      return "moved";
  }
  return "";
}

}  // namespace

std::string FormatTrajectory(const std::vector<plan::Snapshot>& samples) {
  std::string csv =
      "time_s,finger,role,tip_x_m,tip_y_m,tip_z_m,contact_x_m,contact_y_m,contact_z_m,"
      "normal_x,normal_y,normal_z,force_x_N,force_y_N,force_z_N\r\n";
  for (const plan::Snapshot& sample : samples) {
    for (const plan::FingerState& state : sample.fingers) {
      csv += FormatDouble(sample.time_s) + "," + std::to_string(state.finger) + "," +
             RoleName(state.role);
      for (const Eigen::Vector3d* v :
           {&state.tip_W, &state.contact_W, &state.normal_W, &state.force_W}) {
        for (const double x : *v) csv += "," + FormatDouble(x);
      }
      csv += "\r\n";
    }
  }
  return csv;
}

}  // namespace regrasp::sim
