#include "sim/actuation/hand_links.h"

#include <algorithm>

namespace regrasp::sim {

using kinematics::HandModel;

HandLinks::HandLinks(const HandModel& hand) {
  std::vector<HandModel::Part> parts;
  const auto add = [&](FingerIndex finger, const std::vector<kinematics::LinkShape>& shapes) {
    for (int i = 0; i < std::ssize(shapes); ++i) {
      parts.push_back({finger, i});
      links_.push_back({shapes[i], finger, collision::BoundingSphereOf(shapes[i].shape)});
    }
  };
  add({}, hand.palm);
  for (FingerIndex f{0}; f < std::ssize(hand.fingers); ++f) add(f, hand.fingers[f].shapes);
  may_touch_.assign(parts.size() * parts.size(), true);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < parts.size(); ++j) {
      const std::pair<HandModel::Part, HandModel::Part> pair = std::minmax(parts[i], parts[j]);
      may_touch_[i * parts.size() + j] = i == j || std::ranges::binary_search(hand.ignored, pair);
    }
  }
}

std::vector<HandLinks::Placed> HandLinks::Place(
    const HandModel& hand,
    const std::vector<kinematics::JointConfiguration>& configurations) const {
  std::vector<kinematics::JointFrames> frames;
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    frames.push_back(kinematics::FramesOf(hand.fingers[i], configurations[i]));
  }
  const Eigen::Isometry3d palm = Eigen::Isometry3d::Identity();
  std::vector<Placed> placed;
  placed.reserve(links_.size());
  for (const Link& link : links_) {
    const Eigen::Isometry3d& pose = link.after == 0 ? palm : frames[link.finger][link.after - 1];
    placed.push_back({{&link.shape, pose, {pose * link.sphere.centre, link.sphere.radius}}, &link});
  }
  return placed;
}

bool HandLinks::MayTouch(const Placed& a, const Placed& b) const {
  return may_touch_[IndexOf(a) * links_.size() + IndexOf(b)];
}

}  // namespace regrasp::sim
