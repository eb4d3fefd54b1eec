#pragma once

#include <vector>

namespace regrasp::sim {

/// Everything that the next steps of a simulation depend on, in the engine's units: replaying from
/// a saved state gives the same bits.
struct EngineState {
  double time = 0;
  std::vector<double> qpos, qvel, act, qacc_warmstart;
};

}  // namespace regrasp::sim
