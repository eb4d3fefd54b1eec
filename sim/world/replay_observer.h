#pragma once

#include <functional>

#include "planner/plan/snapshot.h"

namespace regrasp::sim {

/// Callbacks of a running replay; both may be empty.
struct ReplayObserver {
  std::function<void(const plan::Snapshot&)> on_sample;  ///< called every `sample_interval_s`
  double sample_interval_s = 0.01;
  std::function<void(int done, int total)> on_progress;  ///< called after every step
};

}  // namespace regrasp::sim
