#pragma once

#include <mujoco/mujoco.h>

#include "sim/scene/engine_state.h"

namespace regrasp::sim {

/// Takes MuJoCo's two global hooks while any simulation lives, in whatever thread: its errors
/// become UnstableError, its warnings neither reach the terminal nor leave a log file.
class EngineHooks {
 public:
  EngineHooks();
  ~EngineHooks();
  EngineHooks(const EngineHooks&) = delete;
  EngineHooks& operator=(const EngineHooks&) = delete;
};

/// @throws UnstableError  a warning says that the last step is not to be trusted, or the state is
///                        not finite.
void CheckState(const mjModel& model, const mjData& data);

[[nodiscard]] EngineState SaveState(const mjModel& model, const mjData& data);
/// Of the same model. Warnings of what happened since are forgotten.
void RestoreState(const EngineState& state, mjData& data);

}  // namespace regrasp::sim
