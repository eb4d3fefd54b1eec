#include "planner/gait/gait.h"

#include <algorithm>

#include "planner/object/rotation.h"

namespace regrasp::gait {

Keyframe Between(const Keyframe& from, const Keyframe& to, double fraction) {
  Keyframe frame{object::PoseBetween(from.pose, to.pose, fraction), {}};
  for (std::size_t i = 0; i < from.configurations.size(); ++i) {
    frame.configurations.emplace_back(from.configurations[i] +
                                      fraction * (to.configurations[i] - from.configurations[i]));
  }
  return frame;
}

bool AreHeldBy(const std::vector<FingerIndex>& fingers, const std::vector<int>& contacts,
               const ContactAssignment& assignment) {
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    if (assignment[fingers[i]] != contacts[i]) return false;
  }
  return true;
}

PlanSegment Reversed(PlanSegment segment) {
  std::ranges::reverse(segment.path);
  std::ranges::reverse(segment.waypoints);
  std::ranges::reverse(segment.waypoint_frames);
  const int last = static_cast<int>(segment.path.size()) - 1;
  for (int& at : segment.waypoint_frames) at = last - at;
  for (PlanSegment::Slid& slid : segment.slid) std::swap(slid.from, slid.to);
  if (segment.kind == PlanSegment::Kind::kPlace) {
    segment.kind = PlanSegment::Kind::kRelease;
  } else if (segment.kind == PlanSegment::Kind::kRelease) {
    segment.kind = PlanSegment::Kind::kPlace;
  }
  return segment;
}

const Keyframe& EndOf(const Gait& gait) {
  return gait.segments.empty() ? gait.start : gait.segments.back().path.back();
}

ContactAssignment AssignmentAtEnd(const Gait& gait) {
  ContactAssignment assignment = gait.initial;
  for (const PlanSegment& segment : gait.segments) {
    if (segment.kind == PlanSegment::Kind::kPlace) assignment[segment.finger] = segment.contact;
    if (segment.kind == PlanSegment::Kind::kRelease) assignment[segment.finger] = kNone;
    for (const PlanSegment::Slid& slid : segment.slid) assignment[slid.finger] = slid.to;
  }
  return assignment;
}

void AppendReversed(const std::vector<PlanSegment>& segments, Gait& gait) {
  for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment) {
    gait.segments.push_back(Reversed(*segment));
  }
}

}  // namespace regrasp::gait
