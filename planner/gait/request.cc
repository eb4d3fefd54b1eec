#include "planner/gait/request.h"

#include <algorithm>

namespace regrasp::gait {

hand::Hand FingersOf(const planning::InHandTask& task) {
  double radius = 0;
  for (const kinematics::Finger& finger : task.hand->fingers) {
    radius = std::max(radius, finger.tip.radius);
  }
  return {static_cast<int>(task.hand->fingers.size()), radius / task.scale};
}

}  // namespace regrasp::gait
