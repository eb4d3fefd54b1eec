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

std::vector<const HandPath*> PathsOf(const Step& step) {
  std::vector<const HandPath*> paths;
  if (const auto* move = std::get_if<Move>(&step)) paths.push_back(&move->path);
  if (const auto* align = std::get_if<Align>(&step); align != nullptr && align->motion) {
    for (const HandPath& path : *align->motion) paths.push_back(&path);
  }
  if (const auto* change = std::get_if<Switch>(&step); change != nullptr && change->motion) {
    paths.push_back(&change->motion->place);
    paths.push_back(&change->motion->release);
  }
  return paths;
}

}  // namespace regrasp::plan
