#include "sim/validation/engine_results.h"

#include <algorithm>

namespace regrasp::validation {
namespace {

void AddEngineStep(plan::EntryIndex index, const sim::StepMotion& motion,
                   const sim::HandMeasures& measures, const sim::HandTolerance& tolerance,
                   EngineResult& result) {
  result.off_m = std::max(result.off_m, measures.off_m);
  result.off_rad = std::max(result.off_rad, measures.off_rad);
  result.margin = std::min(result.margin, sim::ToleranceMargin(measures, tolerance));
  if (!result.passed || motion.reason == plan::Reason::kNone) return;
  result.passed = false;
  result.failed = index;
  result.detail = motion.detail;
}

}  // namespace

std::vector<EngineResult> EngineResultsOf(const Report& report) {
  if (!report.settings || !report.settings->hand ||
      report.settings->engine != sim::EngineChoice::kBoth) {
    return {};
  }
  const sim::HandTolerance& tolerance = report.settings->hand->tolerance;
  std::vector<EngineResult> results(2);
  results[0].engine = "MuJoCo";
  results[1].engine = "ODE";
  for (const ReportStep& step : report.steps) {
    if (!step.replay) continue;
    const sim::StepReplay& replay = *step.replay;
    AddEngineStep(step.check.index, replay, *replay.hand, tolerance, results[0]);
    if (replay.ode)
      AddEngineStep(step.check.index, *replay.ode, *replay.ode_hand, tolerance, results[1]);
  }
  return results;
}

}  // namespace regrasp::validation
