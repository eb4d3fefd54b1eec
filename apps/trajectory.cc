#include "apps/trajectory.h"

#include "planner/base/number.h"

namespace regrasp {

namespace {

const char* RoleName(FingerRole role) {
  switch (role) {
    case FingerRole::kFree:
      return "free";
    case FingerRole::kHolding:
      return "holding";
    case FingerRole::kPlaced:
      return "placed";
    case FingerRole::kReleased:
      return "released";
    case FingerRole::kMoved:
      return "moved";
  }
  return "";
}

}  // namespace

void TrajectoryTable::Add(const Snapshot& snapshot) {
  for (const FingerState& state : snapshot.fingers) {
    text_ += FormatDouble(snapshot.time_s) + "," + std::to_string(state.finger) + "," +
             RoleName(state.role);
    for (const Eigen::Vector3d& vector : {state.tip_W, state.force_W}) {
      for (const double value : vector) text_ += "," + FormatDouble(value);
    }
    text_ += '\n';
  }
}

}  // namespace regrasp
