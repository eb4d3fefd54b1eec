#include "planner/gait/keyframe.h"

namespace regrasp::gait {

Eigen::Isometry3d Between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                          double share) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(from.linear())
                      .slerp(share, Eigen::Quaterniond(to.linear()))
                      .toRotationMatrix();
  pose.translation() = from.translation() + share * (to.translation() - from.translation());
  return pose;
}

Keyframe Between(const Keyframe& from, const Keyframe& to, double share) {
  Keyframe frame{Between(from.pose, to.pose, share), {}};
  for (std::size_t i = 0; i < from.postures.size(); ++i) {
    frame.postures.emplace_back(from.postures[i] + share * (to.postures[i] - from.postures[i]));
  }
  return frame;
}

}  // namespace regrasp::gait
