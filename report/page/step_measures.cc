#include "report/page/step_measures.h"

#include <cmath>

#include "planner/base/angle.h"
#include "sim/world/cone_margin.h"

namespace regrasp::report {

namespace {

/// A replay that became unstable may have measured infinity.
std::optional<double> IfFinite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void AddReplay(const sim::StepReplay& replay, StepMeasures& measures) {
  measures.moved_m = IfFinite(replay.moved_m);
  measures.slip_m = IfFinite(replay.slip_m);
  if (const auto margin = sim::SmallestMargin(replay.rest_margins)) {
    measures.rest_margin_deg = IfFinite(Degrees(*margin));
  }
}

}  // namespace

std::vector<StepMeasures> MeasureSteps(const Report& report) {
  std::vector<StepMeasures> all;
  for (const ReportStep& step : report.steps) {
    StepMeasures& measures = all.emplace_back();
    if (!step.skipped && step.check.required) {
      measures.margin_deg = Degrees(report.half_angle - step.check.required->upper);
    }
    if (!step.skipped && step.replay) AddReplay(*step.replay, measures);
  }
  return all;
}

}  // namespace regrasp::report
