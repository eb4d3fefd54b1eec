#include "planner/gait/gait.h"

#include <algorithm>

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

bool AreHeldBy(const std::vector<FingerIndex>& fingers, const std::vector<int>& contacts,
               const ContactAssignment& holding) {
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (holding[fingers[i]] != contacts[i]) return false;
  }
  return true;
}

PlanSegment Reversed(PlanSegment stretch) {
  std::ranges::reverse(stretch.path);
  std::ranges::reverse(stretch.along);
  std::ranges::reverse(stretch.along_at);
  const int last = static_cast<int>(stretch.path.size()) - 1;
  for (int& at : stretch.along_at) at = last - at;
  for (PlanSegment::Slid& slid : stretch.slid) std::swap(slid.from, slid.to);
  if (stretch.kind == PlanSegment::Kind::kPlace) {
    stretch.kind = PlanSegment::Kind::kRelease;
  } else if (stretch.kind == PlanSegment::Kind::kRelease) {
    stretch.kind = PlanSegment::Kind::kPlace;
  }
  return stretch;
}

const Keyframe& EndOf(const Gait& gait) {
  return gait.segments.empty() ? gait.start : gait.segments.back().path.back();
}

ContactAssignment AssignmentAtEnd(const Gait& gait) {
  ContactAssignment holding = gait.initial;
  for (const PlanSegment& stretch : gait.segments) {
    if (stretch.kind == PlanSegment::Kind::kPlace) holding[stretch.finger] = stretch.contact;
    if (stretch.kind == PlanSegment::Kind::kRelease) holding[stretch.finger] = kNone;
    for (const PlanSegment::Slid& slid : stretch.slid) holding[slid.finger] = slid.to;
  }
  return holding;
}

void AppendReversed(const std::vector<PlanSegment>& segments, Gait& gait) {
  for (auto stretch = segments.rbegin(); stretch != segments.rend(); ++stretch) {
    gait.segments.push_back(Reversed(*stretch));
  }
}

}  // namespace regrasp::gait
