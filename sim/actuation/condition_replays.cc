#include "sim/actuation/condition_replays.h"

#include <algorithm>
#include <mutex>

#include "planner/base/error.h"
#include "planner/base/in_blocks.h"
#include "sim/actuation/ode_hand.h"
#include "sim/actuation/tip_geometry.h"

namespace regrasp::sim {
namespace {

/// Describe the end of a replay. If it is not reached, it is the largest deviation of the last
/// step.
void DescribeEnd(const ReplayResult& replay, const plan::Plan& plan, const HandTolerance& tolerance,
                 ConditionResult& result) {
  const HandMeasures& last = *replay.steps.back().hand;
  result.reaches_end = replay.steps.size() == plan.steps.size() + 1 && last.is_complete;
  result.end_m = result.reaches_end ? last.rest_off_m : last.off_m;
  result.end_rad = result.reaches_end ? last.rest_off_rad : last.off_rad;
  result.ends_within = result.reaches_end && result.end_m <= tolerance.length_m &&
                       result.end_rad <= tolerance.angle_rad;
  result.margin = ToleranceMargin(replay, tolerance);
}

ConditionResult ReplayUnder(const kinematics::HandFile& file, const object::Polyhedron& solid,
                            const plan::Plan& plan, const HandReplayOptions& nominal,
                            const HandCondition& condition) {
  ConditionResult result;
  result.condition = condition;
  const HandReplayOptions options = OptionsUnder(condition, nominal);
  try {
    if (options.tip != nominal.tip) static_cast<void>(TipShapesOf(file, options.tip));
    if (options.engine == EngineChoice::kOde) CheckOdePhysics(options.physics);
  } catch (const InputError& error) {
    result.applies = false;
    result.detail = error.what();
    return result;
  }
  const ReplayResult replay = ReplayHand(file, solid, plan, options);
  const auto failed = std::ranges::find_if(
      replay.steps, [](const StepReplay& step) { return step.reason != plan::Reason::kNone; });
  if (failed != replay.steps.end()) {
    result.failed = failed->index;
    result.reason = failed->reason;
    result.detail = failed->detail;
  }
  DescribeEnd(replay, plan, options.tolerance, result);
  return result;
}

}  // namespace

int ConditionSummary::applicable() const {
  return static_cast<int>(std::ranges::count_if(results, &ConditionResult::applies));
}

int ConditionSummary::passed() const {
  return static_cast<int>(std::ranges::count_if(results, &ConditionResult::passed));
}

int ConditionSummary::ended_within() const {
  return static_cast<int>(std::ranges::count_if(results, &ConditionResult::ends_within));
}

double ConditionSummary::share() const {
  return applicable() == 0 ? 0 : static_cast<double>(passed()) / applicable();
}

bool ConditionSummary::enough() const { return !required || share() >= *required; }

double ToleranceMargin(const HandMeasures& measures, const HandTolerance& tolerance) {
  const double at_rest = tolerance.at_rest;
  return 1 - std::max({measures.off_m / tolerance.length_m, measures.off_rad / tolerance.angle_rad,
                       measures.rest_off_m / (at_rest * tolerance.length_m),
                       measures.rest_off_rad / (at_rest * tolerance.angle_rad),
                       measures.slip_m / tolerance.slip_m});
}

double ToleranceMargin(const ReplayResult& result, const HandTolerance& tolerance) {
  double least = 1;
  for (const StepReplay& step : result.steps) {
    least = std::min(least, ToleranceMargin(*step.hand, tolerance));
  }
  return least;
}

ConditionSummary RunConditions(const kinematics::HandFile& file, const object::Polyhedron& solid,
                               const plan::Plan& plan, const HandReplayOptions& nominal,
                               const std::vector<HandCondition>& conditions, int jobs,
                               const std::function<void(int done)>& progress) {
  ConditionSummary summary;
  summary.results.resize(conditions.size());
  std::mutex mutex;
  int done = 0;
  InBlocks(conditions.size(), 1, jobs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      summary.results[i] = ReplayUnder(file, solid, plan, nominal, conditions[i]);
      const std::scoped_lock lock(mutex);
      ++done;
      if (progress) progress(done);
    }
  });
  return summary;
}

}  // namespace regrasp::sim
