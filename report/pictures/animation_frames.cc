#include "report/pictures/animation_frames.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "planner/base/number.h"
#include "planner/object/rotation.h"
#include "render/picture/caption.h"
#include "report/pictures/object_progress.h"

namespace regrasp::report {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using render::ViewerContact;
using render::ViewerContactState;
using render::ViewerSample;

/// Displacement of a link, a finger or the object that is visible, in diameters, and visible change
/// of a force relative to the largest one.
constexpr double kVisibleTravel = 1e-3;
constexpr double kVisibleForce = 0.02;

ViewerContact ContactBetween(const ViewerContact& a, const ViewerContact& b, double share) {
  if (a.state != b.state) return share < 1 ? a : b;
  ViewerContact contact = a;
  contact.point += share * (b.point - a.point);
  contact.force += share * (b.force - a.force);
  const Vector3d inward = (1 - share) * a.inward + share * b.inward;
  if (inward.norm() > 0) contact.inward = inward.normalized();
  return contact;
}

ViewerSample SampleBetween(const ViewerSample& a, const ViewerSample& b, double share) {
  ViewerSample sample = a;
  sample.X_WO = object::PoseBetween(a.X_WO, b.X_WO, share);
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    sample.joints[i] += share * (b.joints[i] - a.joints[i]);
  }
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    sample.contacts[i] = ContactBetween(a.contacts[i], b.contacts[i], share);
  }
  return sample;
}

ViewerSample SampleAt(const std::vector<ViewerSample>& samples, double time_s) {
  const auto after = std::ranges::lower_bound(samples, time_s, {}, &ViewerSample::time_s);
  if (after == samples.begin()) return samples.front();
  if (after == samples.end()) return samples.back();
  const ViewerSample& before = *(after - 1);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return SampleBetween(before, *after, share);
}

plan::Snapshot SnapshotOf(const ViewerSample& sample, const std::vector<FingerIndex>& fingers,
                          const HandPicture* hand) {
  plan::Snapshot snapshot;
  snapshot.X_WO = sample.X_WO;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    const ViewerContact& contact = sample.contacts[i];
    if (contact.state == ViewerContactState::kHidden) continue;
    plan::FingerState& finger = snapshot.fingers.emplace_back();
    finger.finger = fingers[i];
    finger.role = contact.state == ViewerContactState::kHolding ? plan::FingerRole::kHolding
                                                                : plan::FingerRole::kFree;
    finger.contact_W = finger.tip_W = contact.point;
    finger.normal_W = contact.inward;
    finger.force_W = contact.force;
  }
  if (hand != nullptr) hand->Pose(sample.joints, snapshot);
  return snapshot;
}

/// Decides whether two states look different.
class VisibleChange {
 public:
  VisibleChange(const std::vector<ViewerSample>& samples, double diameter_m)
      : diameter_m_(diameter_m) {
    for (const ViewerSample& sample : samples) {
      for (const ViewerContact& contact : sample.contacts) {
        largest_force_ = std::max(largest_force_, contact.force.norm());
      }
    }
  }

  [[nodiscard]] bool operator()(const plan::Snapshot& a, const plan::Snapshot& b) const {
    if (a.fingers.size() != b.fingers.size() || Moves(a.X_WO, b.X_WO)) return true;
    for (std::size_t i = 0; i < a.links_W.size(); ++i) {
      if (Moves(a.links_W[i], b.links_W[i])) return true;
    }
    for (std::size_t i = 0; i < a.fingers.size(); ++i) {
      const plan::FingerState& from = a.fingers[i];
      const plan::FingerState& to = b.fingers[i];
      const bool differs = from.finger != to.finger || from.role != to.role ||
                           (from.contact_W - to.contact_W).norm() > kVisibleTravel * diameter_m_ ||
                           (from.force_W - to.force_W).norm() > kVisibleForce * largest_force_;
      if (differs) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool Moves(const Isometry3d& a, const Isometry3d& b) const {
    const double travel = (a.translation() - b.translation()).norm();
    const double turn = (a.linear() - b.linear()).norm();
    return travel > kVisibleTravel * diameter_m_ || turn > kVisibleTravel;
  }

  double diameter_m_;
  double largest_force_ = 0;
};

/// Return " · speed 2.5×", or nothing if times do not have the scale of the simulation.
std::string SpeedText(const ReplayTimeline& timeline, double speed) {
  constexpr int kDigits = 4;
  return timeline.simulated_time ? " · speed " + FormatPlain(speed, kDigits) + "×" : "";
}

}  // namespace

AnimationFrames MakeAnimationFrames(const plan::Plan& plan, const std::vector<ShownEntry>& shown,
                                    const ReplayTimeline& timeline,
                                    const std::vector<FingerIndex>& fingers,
                                    const HandPicture* hand, double diameter_m) {
  const bool fails = shown.back().marks.has_value();
  const render::AnimationSchedule schedule = render::ScheduleAnimation(timeline.ends, fails);
  const std::string speed = SpeedText(timeline, schedule.speed);
  const VisibleChange differs(timeline.samples, diameter_m);
  std::optional<ObjectProgress> progress;
  if (hand != nullptr) progress.emplace(hand->PlannedPoses());
  const std::vector<std::string> names =
      hand != nullptr ? hand->FingerNames() : std::vector<std::string>();
  AnimationFrames animation;
  int last_entry = -1;
  for (const auto& [entry, time_s, frames] : schedule.instants) {
    const ShownEntry& of = shown[entry];
    const bool is_last = time_s == timeline.ends.back();
    const bool is_fault = fails && is_last;
    plan::Snapshot snapshot =
        is_fault ? of.snapshot : SnapshotOf(SampleAt(timeline.samples, time_s), fingers, hand);
    if (progress) progress->Follow(snapshot.X_WO);
    if (!is_fault && entry == last_entry && !animation.snapshots.empty() &&
        !differs(animation.snapshots.back(), snapshot)) {
      animation.frames.back().frames += frames;
      continue;
    }
    last_entry = entry;
    animation.snapshots.push_back(std::move(snapshot));
    const plan::EntryIndex index = of.step->check.index;
    const std::string caption = is_fault ? EntryCaption(plan, *of.step, names)
                                         : render::FrameCaption(plan, index, names) + speed;
    animation.frames.push_back({{&animation.snapshots.back(),
                                 {caption, progress ? progress->Text() : ""},
                                 is_fault ? &*of.marks : nullptr},
                                frames});
  }
  return animation;
}

}  // namespace regrasp::report
