#include "sim/scene/engine.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <mutex>
#include <string>

namespace regrasp::sim {

namespace {

/// Called by the engine where it would otherwise end the process.
[[noreturn]] void ThrowError(const char* message) {
  throw UnstableError(std::string("engine error: ") + message);
}

/// The engine counts warnings of a simulation in mjData, where CheckState looks; printing and the
/// log file are what this replaces.
void IgnoreWarning(const char* /*message*/) {}

/// What the hooks were before, while simulations live, perhaps in several threads.
struct HooksBefore {
  std::mutex mutex;
  int living = 0;
  void (*error)(const char*) = nullptr;
  void (*warning)(const char*) = nullptr;
};
HooksBefore before;

/// The warnings that mean that a step is not to be trusted; the others are of the renderer.
constexpr std::array kFatalWarnings = {mjWARN_INERTIA, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL,
                                       mjWARN_BADQPOS, mjWARN_BADQVEL,     mjWARN_BADQACC,
                                       mjWARN_BADCTRL};

bool AreFinite(const mjtNum* values, int count) {
  // After every step: 0 times a number is 0 only where it is finite, and vectors are summed fast.
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
