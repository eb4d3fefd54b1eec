#include "planner/plan/hand_path.h"

namespace regrasp::plan {

HandState StateBetween(const HandState& from, const HandState& to, double share) {
  HandState state = from;
  state.pose.translation() += share * (to.pose.translation() - from.pose.translation());
  const Eigen::AngleAxisd turn(from.pose.linear().transpose() * to.pose.linear());
  state.pose.linear() =
      from.pose.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  for (std::size_t i = 0; i < from.joints.size(); ++i) {
    for (std::size_t k = 0; k < from.joints[i].size(); ++k) {
      state.joints[i][k] += share * (to.joints[i][k] - from.joints[i][k]);
    }
  }
  return state;
}

}  // namespace regrasp::plan
