#include "sim/actuation/simulate_execution.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/plan/projection.h"
#include "sim/actuation/condition_replays.h"
#include "sim/actuation/hand_replay.h"

namespace regrasp::sim {
namespace {

/// Replays of each thread, one per condition, since successive plans of a thread have many steps in
/// common.
class ReplaysByThread {
 public:
  ReplaysByThread(kinematics::HandFile file, const object::Polyhedron& solid,
                  std::vector<HandReplayOptions> conditions)
      : file_(std::move(file)), solid_(solid), conditions_(std::move(conditions)) {}

  [[nodiscard]] const std::vector<HandReplayOptions>& conditions() const { return conditions_; }

  HandReplays& Own(std::size_t condition) {
    const std::scoped_lock lock(mutex_);
    auto& own = by_thread_[{std::this_thread::get_id(), condition}];
    if (!own) own = std::make_unique<HandReplays>(file_, solid_, conditions_[condition]);
    return *own;
  }

 private:
  kinematics::HandFile file_;
  const object::Polyhedron& solid_;
  std::vector<HandReplayOptions> conditions_;
  std::mutex mutex_;
  std::map<std::pair<std::thread::id, std::size_t>, std::unique_ptr<HandReplays>> by_thread_;
};

planning::ExecutionResult ResultOf(const ReplayResult& result, const plan::Plan& plan,
                                   const HandTolerance& tolerance) {
  const bool fails = !result.steps.empty() && result.steps.back().reason != plan::Reason::kNone;
  // The first entry is the start grasp.
  const std::ptrdiff_t passed = std::ssize(result.steps) - (fails ? 1 : 0);
  const bool is_whole = passed == std::ssize(plan.steps) + 1;
  planning::ExecutionResult carried{
      .is_held = passed > 0,
      .steps = static_cast<int>(std::max<std::ptrdiff_t>(0, passed - 1)),
      .is_whole = is_whole,
      .tolerance_margin = is_whole ? std::max(0.0, ToleranceMargin(result, tolerance)) : 0,
      .is_cut_short = !fails && !is_whole};
  if (fails) {
    carried.reason = result.steps.back().reason;
    carried.detail = result.steps.back().detail;
  }
  return carried;
}

}  // namespace

std::vector<HandReplayOptions> PlanningConditions(PlanningRobustness robustness) {
  const HandReplayOptions nominal;
  if (robustness == PlanningRobustness::kNominal) return {nominal};
  HandReplayOptions sensors = nominal;
  sensors.disturbance_ratio = 0;
  sensors.friction_factor = 0.9;
  sensors.mass_factor = 1.1;
  sensors.physics.gain_factor = 0.9;
  sensors.physics.joint_friction_Nm = 0.01;
  sensors.sensing.pose_bias_m = 6e-4;
  sensors.sensing.pose_bias_rad = 0.0105;
  sensors.sensing.touch_N = 0.3;
  sensors.sensing.command_delay_s = 0.01;
  HandReplayOptions joints = nominal;
  joints.disturbance_ratio = 0;
  joints.sensing.joint_bias_rad = 0.0087;
  HandReplayOptions friction = nominal;
  friction.disturbance_ratio = 0;
  friction.friction_factor = 0.8;
  return {sensors, joints, friction, nominal};
}

std::function<std::optional<planning::ExecutionResult>(const plan::Plan&, const Deadline&)>
ExecutionSimulator(kinematics::HandFile file, const object::Polyhedron& solid,
                   std::vector<HandReplayOptions> conditions) {
  const auto replays =
      std::make_shared<ReplaysByThread>(std::move(file), solid, std::move(conditions));
  return [replays, &solid](const plan::Plan& plan,
                           const Deadline& deadline) -> std::optional<planning::ExecutionResult> {
    try {
      const plan::Plan projected = plan::ProjectPlan(solid, plan);
      std::optional<planning::ExecutionResult> worst;
      for (std::size_t k = 0; k < replays->conditions().size(); ++k) {
        planning::ExecutionResult found = ResultOf(replays->Own(k).Replay(projected, deadline),
                                                   plan, replays->conditions()[k].tolerance);
        const double tolerance_margin =
            worst ? std::min(worst->tolerance_margin, found.tolerance_margin)
                  : found.tolerance_margin;
        if (!worst || found.steps < worst->steps || !found.is_whole) worst = std::move(found);
        worst->tolerance_margin = tolerance_margin;
        if (!worst->is_whole) break;
      }
      return worst;
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
}

}  // namespace regrasp::sim
