#include "sim/actuation/simulate_execution.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "planner/base/error.h"
#include "planner/object/body_measures.h"
#include "planner/plan/locate.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {
namespace {

/// The least share that a step leaves of what is allowed. Shakes are left out, and torques: the
/// squeeze is chosen by their limits.
double SpareOf(const HandMeasures& measures, const HandTolerance& tolerance) {
  const double at_rest = tolerance.at_rest;
  return 1 - std::max({measures.off_m / tolerance.length_m, measures.off_rad / tolerance.angle_rad,
                       measures.rest_off_m / (at_rest * tolerance.length_m),
                       measures.rest_off_rad / (at_rest * tolerance.angle_rad),
                       measures.slip_m / tolerance.slip_m});
}

double SpareOf(const ReplayResult& result) {
  double least = 1;
  for (const StepReplay& step : result.steps) {
    least = std::min(least, SpareOf(*step.hand, HandReplayOptions().tolerance));
  }
  return std::max(0.0, least);
}

/// Of plans for one scale at a time.
struct Replays {
  double scale = 0;
  std::unique_ptr<HandReplays> replays = nullptr;
};

/// What each thread replays with: its plans have much in common with the one before.
class ReplaysByThread {
 public:
  ReplaysByThread(kinematics::HandFile file, const object::Polyhedron& solid)
      : file_(std::move(file)), solid_(solid) {}

  HandReplays& At(double scale) {
    Replays& own = Own();
    if (!own.replays || scale != own.scale) {
      HandReplayOptions options;
      options.mass_kg = object::MeasureBody(solid_, scale).mass_kg;
      own = {scale, std::make_unique<HandReplays>(file_, solid_, options)};
    }
    return *own.replays;
  }

 private:
  Replays& Own() {
    const std::scoped_lock lock(mutex_);
    return by_thread_[std::this_thread::get_id()];  // which stays where it is
  }

  kinematics::HandFile file_;
  const object::Polyhedron& solid_;
  std::mutex mutex_;
  std::map<std::thread::id, Replays> by_thread_;
};

}  // namespace

std::function<std::optional<planning::ExecutionResult>(const plan::Plan&, const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid) {
  const auto replays = std::make_shared<ReplaysByThread>(std::move(file), solid);
  return [replays, &solid](const plan::Plan& plan,
                           const Deadline& deadline) -> std::optional<planning::ExecutionResult> {
    try {
      const ReplayResult result =
          replays->At(plan.scale).Replay(plan::LocatePlan(solid, plan), deadline);
      const bool fails = !result.steps.empty() && result.steps.back().reason != plan::Reason::kNone;
      // The first entry is the start grasp.
      const std::ptrdiff_t passed = std::ssize(result.steps) - (fails ? 1 : 0);
      const bool is_whole = passed == std::ssize(plan.steps) + 1;
      planning::ExecutionResult carried{
          .is_held = passed > 0,
          .steps = static_cast<int>(std::max<std::ptrdiff_t>(0, passed - 1)),
          .is_whole = is_whole,
          .spare = is_whole ? SpareOf(result) : 0,
          .is_cut_short = !fails && !is_whole};
      if (fails) {
        carried.reason = result.steps.back().reason;
        carried.detail = result.steps.back().detail;
      }
      return carried;
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
}

}  // namespace regrasp::sim
