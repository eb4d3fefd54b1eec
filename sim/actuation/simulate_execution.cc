#include "sim/actuation/simulate_execution.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/plan/projection.h"
#include "sim/actuation/condition_replays.h"
#include "sim/actuation/conditions.h"
#include "sim/actuation/drive_servo.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/tip_geometry.h"

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

  /// @param plan  the next plan to replay.
  HandReplays& Own(std::size_t condition, const plan::Plan& plan) {
    const std::scoped_lock lock(mutex_);
    auto& own = by_thread_[{std::this_thread::get_id(), condition}];
    if (!own.replays || own.up != plan.hand->up) {
      own = {plan.hand->up, std::make_unique<HandReplays>(kinematics::HandOfPlan(file_, plan),
                                                          solid_, conditions_[condition])};
    }
    return *own.replays;
  }

 private:
  kinematics::HandFile file_;
  const object::Polyhedron& solid_;
  std::vector<HandReplayOptions> conditions_;
  std::mutex mutex_;
  struct OwnReplays {
    std::optional<Eigen::Vector3d> up;  ///< plan::HandUse::up
    std::unique_ptr<HandReplays> replays;
  };
  std::map<std::pair<std::thread::id, std::size_t>, OwnReplays> by_thread_;
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

/// A standard condition with the options of its replay.
struct RatedCondition {
  std::string name;
  HandReplayOptions options;
};

/// Return the standard conditions that exist for a hand, in the order of their rates of failure of
/// 33 plans (bench/hand_conditions.md).
std::vector<RatedCondition> RatedConditions(const kinematics::HandFile& file) {
  constexpr std::array kOftenFailed = {"default-contacts", "torsion-5mm",        "joints-1deg",
                                       "pyramidal-cones",  "fingertip-geometry", "start-off",
                                       "realistic",        "joint-friction"};
  std::vector<RatedCondition> conditions;
  for (const HandCondition& condition : StandardConditions()) {
    RatedCondition rated{condition.name, OptionsUnder(condition, {})};
    rated.options.to_end = false;
    try {
      static_cast<void>(TipShapesOf(file, rated.options.tip));
      conditions.push_back(std::move(rated));
    } catch (const InputError&) {
      // The hand has no geometry for this condition.
    }
  }
  std::ranges::stable_sort(conditions, {}, [&](const RatedCondition& condition) {
    return std::ranges::find(kOftenFailed, condition.name) - kOftenFailed.begin();
  });
  return conditions;
}

/// Return whether a hand executes a plan under a condition; nullopt if the deadline passes before.
std::optional<bool> Executes(const kinematics::HandFile& file, const object::Polyhedron& solid,
                             const plan::Plan& projected, const HandReplayOptions& options,
                             const Deadline& deadline) {
  const ReplayResult replay = HandReplays(file, solid, options).Replay(projected, deadline);
  const planning::ExecutionResult found = ResultOf(replay, projected, options.tolerance);
  if (found.is_cut_short) return std::nullopt;
  return found.is_whole;
}

}  // namespace

std::vector<HandReplayOptions> PlanningConditions(PlanningRobustness robustness) {
  const HandReplayOptions nominal;
  if (robustness == PlanningRobustness::kNominal) return {nominal};
  std::vector<HandReplayOptions> conditions;
  for (const char* name : {"realistic", "joints-0.5deg", "friction-minus-20"}) {
    const auto found = std::ranges::find(StandardConditions(), name, &HandCondition::name);
    HandReplayOptions& options = conditions.emplace_back(OptionsUnder(*found, nominal));
    options.to_end = false;
  }
  // Errors of joints and of the other sensors together exceed what any plan tolerates.
  conditions.front().sensing.joint_bias_rad = 0;
  conditions.push_back(nominal);
  return conditions;
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
        planning::ExecutionResult found =
            ResultOf(replays->Own(k, plan).Replay(projected, deadline), plan,
                     replays->conditions()[k].tolerance);
        const double tolerance_margin =
            worst ? std::min(worst->tolerance_margin, found.tolerance_margin)
                  : found.tolerance_margin;
        if (!worst || found.steps < worst->steps || !found.is_whole) worst = std::move(found);
        worst->tolerance_margin = tolerance_margin;
        if (!worst->is_whole) break;
      }
      return worst;
    } catch (const NoActuatorError&) {
      return std::nullopt;
    }
  };
}

std::function<std::optional<planning::RobustnessRating>(const plan::Plan&, int, const Deadline&)>
ExecutionRater(kinematics::HandFile file, const object::Polyhedron& solid) {
  const auto conditions = std::make_shared<std::vector<RatedCondition>>(RatedConditions(file));
  return [file = std::move(file), conditions, &solid](
             const plan::Plan& plan, int most_failures,
             const Deadline& deadline) -> std::optional<planning::RobustnessRating> {
    const plan::Plan projected = plan::ProjectPlan(solid, plan);
    const kinematics::HandFile hand = kinematics::HandOfPlan(file, plan);
    planning::RobustnessRating rating{.conditions = static_cast<int>(conditions->size())};
    for (const RatedCondition& condition : *conditions) {
      const std::optional<bool> executes =
          Executes(hand, solid, projected, condition.options, deadline);
      if (!executes) return std::nullopt;
      if (!*executes) rating.failed.push_back(condition.name);
      if (std::ssize(rating.failed) > most_failures) return std::nullopt;
    }
    return rating;
  };
}

std::function<std::optional<planning::GraspForceNeed>(const plan::Plan&, int)> GraspForceMeter(
    kinematics::HandFile file, const object::Polyhedron& solid) {
  return [file = std::move(file), &solid](const plan::Plan& plan,
                                          int steps) -> std::optional<planning::GraspForceNeed> {
    try {
      return MeasureGraspForce(kinematics::HandOfPlan(file, plan), solid,
                               plan::ProjectPlan(solid, plan), {}, steps);
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
}

}  // namespace regrasp::sim
