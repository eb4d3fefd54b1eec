#include "sim/scene/engine.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <mutex>
#include <string>

namespace regrasp::sim {

namespace {

/// Throw instead of the engine's end of the process.
[[noreturn]] void ThrowError(const char* message) {
  throw UnstableError(std::string("engine error: ") + message);
}

/// Replaces printing and the log file; CheckState reads the engine's counts of warnings in mjData.
void IgnoreWarning(const char* /*message*/) {}

/// Previous hooks while simulations live, possibly in several threads.
struct HooksBefore {
  std::mutex mutex;
  int living = 0;
  void (*error)(const char*) = nullptr;
  void (*warning)(const char*) = nullptr;
};
HooksBefore before;

/// Warnings after which a step is unreliable; the others concern the renderer.
constexpr std::array kFatalWarnings = {mjWARN_INERTIA, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL,
                                       mjWARN_BADQPOS, mjWARN_BADQVEL,     mjWARN_BADQACC,
                                       mjWARN_BADCTRL};

bool AreFinite(const mjtNum* values, int count) {
  // Fast test after every step: 0 times a number is 0 only if it is finite, and vector sums are
  // fast.
  return (0 * Eigen::Map<const Eigen::VectorXd>(values, count)).sum() == 0;
}

}  // namespace

EngineHooks::EngineHooks() {
  const std::scoped_lock lock(before.mutex);
  if (before.living++ > 0) return;
  before.error = mju_user_error;
  before.warning = mju_user_warning;
  mju_user_error = ThrowError;
  mju_user_warning = IgnoreWarning;
}

EngineHooks::~EngineHooks() {
  const std::scoped_lock lock(before.mutex);
  if (--before.living > 0) return;
  mju_user_error = before.error;
  mju_user_warning = before.warning;
}

void CheckState(const mjModel& model, const mjData& data) {
  for (const mjtWarning warning : kFatalWarnings) {
    if (data.warning[warning].number == 0) continue;
    throw UnstableError(mju_warningText(warning, data.warning[warning].lastinfo));
  }
  if (!AreFinite(data.qpos, model.nq) || !AreFinite(data.qvel, model.nv)) {
    throw UnstableError("the state is not finite");
  }
}

EngineState SaveState(const mjModel& model, const mjData& data) {
  return {data.time,
          {data.qpos, data.qpos + model.nq},
          {data.qvel, data.qvel + model.nv},
          {data.act, data.act + model.na},
          {data.qacc_warmstart, data.qacc_warmstart + model.nv}};
}

void RestoreState(const EngineState& state, mjData& data) {
  data.time = state.time;
  std::ranges::copy(state.qpos, data.qpos);
  std::ranges::copy(state.qvel, data.qvel);
  std::ranges::copy(state.act, data.act);
  std::ranges::copy(state.qacc_warmstart, data.qacc_warmstart);
  for (const mjtWarning warning : kFatalWarnings) data.warning[warning].number = 0;
}

}  // namespace regrasp::sim
