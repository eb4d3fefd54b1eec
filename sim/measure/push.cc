#include "sim/measure/push.h"

#include "planner/base/number.h"

namespace regrasp::sim {
namespace {

/// In the plane there are two forces and one torque.
bool IsAxis(int dimension, bool turn, int axis) { return dimension == 3 || turn == (axis == 2); }

/// "+x"
std::string AxisName(const Push& push) {
  return std::string(push.sign > 0 ? "+" : "-") + "xyz"[push.axis];
}

}  // namespace

std::vector<Push> PushDirections(int dimension) {
  std::vector<Push> pushes;
  for (const bool turn : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!IsAxis(dimension, turn, axis)) continue;
      for (const double sign : {1.0, -1.0}) pushes.push_back({turn, axis, sign});
    }
  }
  return pushes;
}

std::string PushName(const Push& push) {
  return (push.turn ? "torque " : "force ") + AxisName(push);
}

std::string PushText(const Push& push, double size, double radius) {
  constexpr int kDigits = 2;
  const std::string axis = AxisName(push);
  return push.turn ? "a twist of " + FormatShort(size * radius, kDigits) + " N·m about " + axis
                   : "a push of " + FormatShort(size, kDigits) + " N along " + axis;
}

grasp::Wrench PushWrench(const Push& push, double size) {
  const Eigen::Vector3d along = push.sign * size * Eigen::Vector3d::Unit(push.axis);
  return push.turn ? grasp::Wrench{Eigen::Vector3d::Zero(), along}
                   : grasp::Wrench{along, Eigen::Vector3d::Zero()};
}

}  // namespace regrasp::sim
