#pragma once

#include <functional>

#include "planner/plan/plan.h"
#include "planner/plan/projection.h"

namespace regrasp::sim {

class HandWorld;

/// Callbacks during a replay; all may be empty.
struct ReplayObserver {
  /// Called after every step, the initial grasp included.
  std::function<void(int done, int total)> on_progress;

  /// Called every `sample_interval_s` of a replay by point fingers, except in disturbance tests.
  std::function<void(const plan::Snapshot&)> on_sample;
  double sample_interval_s = 0.01;

  /// Called after every time step of a replay by a hand, except in disturbance tests.
  std::function<void(const HandWorld&)> on_time_step;
  /// Called in the static grasp after every step of a replay by a hand, before its disturbance
  /// test.
  std::function<void(const HandWorld&, plan::EntryIndex)> on_rest;
};

}  // namespace regrasp::sim
