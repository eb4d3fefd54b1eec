#pragma once

#include <mujoco/mujoco.h>

namespace regrasp::sim {

/// Takes MuJoCo's two global hooks while a simulation lives: its errors become UnstableError, its
/// warnings neither reach the terminal nor leave a log file.
class EngineHooks {
 public:
  EngineHooks();
  ~EngineHooks();
  EngineHooks(const EngineHooks&) = delete;
  EngineHooks& operator=(const EngineHooks&) = delete;

 private:
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

/// @throws UnstableError  a warning says that the last step is not to be trusted, or the state is
///                        not finite.
void CheckState(const mjModel& model, const mjData& data);

/// A warning of what happened since a state was saved is not one of the state.
void ForgetWarnings(mjData& data);

}  // namespace regrasp::sim
