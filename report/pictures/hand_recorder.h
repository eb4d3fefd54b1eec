#pragma once

#include <vector>

#include "planner/plan/plan.h"
#include "report/pictures/replay_timeline.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::report {

/// Records the states of a replay by a hand for the interactive 3-D replay.
class HandRecorder {
 public:
  /// Record the state after a time step, at most one per interval.
  ///
  /// The interval is kInterval. If there are more than kMostSamples states, it doubles and every
  /// second state is removed.
  void Add(const sim::HandWorld& world);
  /// Start the next entry of the plan.
  void EndEntry() { entry_ = plan::EntryIndex(entry_ + 1); }

  [[nodiscard]] const std::vector<HandSample>& samples() const { return samples_; }

  inline static constexpr double kInterval = 0.02;  ///< seconds
  inline static constexpr int kMostSamples = 4000;

 private:
  void Thin();

  plan::EntryIndex entry_{0};
  double interval_s_ = kInterval;
  std::vector<HandSample> samples_;
};

}  // namespace regrasp::report
