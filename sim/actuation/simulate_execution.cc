#include "sim/actuation/simulate_execution.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "planner/base/error.h"
#include "planner/plan/locate.h"
#include "sim/actuation/condition_replays.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {
namespace {

/// Replays of each thread, since successive plans of a thread have many steps in common.
class ReplaysByThread {
 public:
  ReplaysByThread(kinematics::HandFile file, const object::Polyhedron& solid)
      : file_(std::move(file)), solid_(solid) {}

  HandReplays& Own() {
    const std::scoped_lock lock(mutex_);
    std::unique_ptr<HandReplays>& own = by_thread_[std::this_thread::get_id()];
    if (!own) own = std::make_unique<HandReplays>(file_, solid_, HandReplayOptions());
    return *own;
  }

 private:
  kinematics::HandFile file_;
  const object::Polyhedron& solid_;
  std::mutex mutex_;
  std::map<std::thread::id, std::unique_ptr<HandReplays>> by_thread_;
};

}  // namespace

std::function<std::optional<planning::ExecutionResult>(const plan::Plan&, const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid) {
  const auto replays = std::make_shared<ReplaysByThread>(std::move(file), solid);
  return [replays, &solid](const plan::Plan& plan,
                           const Deadline& deadline) -> std::optional<planning::ExecutionResult> {
    try {
      const ReplayResult result = replays->Own().Replay(plan::LocatePlan(solid, plan), deadline);
      const bool fails = !result.steps.empty() && result.steps.back().reason != plan::Reason::kNone;
      // The first entry is the start grasp.
      const std::ptrdiff_t passed = std::ssize(result.steps) - (fails ? 1 : 0);
      const bool is_whole = passed == std::ssize(plan.steps) + 1;
      planning::ExecutionResult carried{
          .is_held = passed > 0,
          .steps = static_cast<int>(std::max<std::ptrdiff_t>(0, passed - 1)),
          .is_whole = is_whole,
          .spare = is_whole ? std::max(0.0, ToleranceMargin(result, HandTolerance())) : 0,
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
