#include "report/pictures/hand_recorder.h"

#include <utility>

#include "planner/plan/projection.h"

namespace regrasp::report {

void HandRecorder::Add(const sim::HandWorld& world) {
  const bool is_first = samples_.empty() || samples_.back().entry != entry_;
  const double half_step = world.timestep() / 2;
  if (!is_first && world.time() < samples_.back().time_s + interval_s_ - half_step) return;
  HandSample& sample = samples_.emplace_back();
  sample.entry = entry_;
  sample.time_s = world.time();
  sample.state = world.state();
  const Eigen::Isometry3d pose = world.object_pose();
  for (FingerIndex f{0}; f < std::ssize(world.hand().fingers); ++f) {
    const sim::TipTouch touch = world.touch(f);
    if (!(touch.force.norm() > 0)) continue;
    plan::FingerState& finger = sample.fingers.emplace_back();
    finger.finger = f;
    finger.role = plan::FingerRole::kHolding;
    finger.contact_W = pose * touch.point_O;
    finger.normal_W = pose.linear() * touch.inward_O;
    finger.force_W = touch.force;
  }
  if (samples_.size() > kMostSamples) Thin();
}

void HandRecorder::Thin() {
  interval_s_ *= 2;
  std::vector<HandSample> kept;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    // The first state of an entry is kept.
    const bool is_first = i == 0 || samples_[i].entry != samples_[i - 1].entry;
    if (is_first || i % 2 == 0) kept.push_back(std::move(samples_[i]));
  }
  samples_ = std::move(kept);
}

}  // namespace regrasp::report
