#include "apps/page/step_measures.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"

namespace regrasp {

namespace {

bool Holds(const FingerState& finger) {
  return finger.role != FingerRole::kFree && finger.role != FingerRole::kReleased;
}

/// A replay that became unstable may have measured infinity.
std::optional<double> IfFinite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void AddReplay(const Report& report, const StepReplay& replay, StepMeasures& measures) {
  const double radius = report.settings->diameter_m / 2;
  measures.moved_m = IfFinite(replay.displacement_m + radius * Radians(replay.rotation_deg));
  measures.slip_m = IfFinite(replay.slip_m);
  if (const auto margin = ConeMarginAtRest(replay.snapshot, report.half_angle)) {
    measures.rest_margin_deg = Degrees(*margin);
  }
}

}  // namespace

std::optional<double> ConeMarginAtRest(const Snapshot& snapshot, double half_angle) {
  std::optional<double> margin;
  for (const FingerState& finger : snapshot.fingers) {
    if (!Holds(finger) || !finger.force_W.allFinite() || finger.force_W.isZero()) continue;
    const double along = finger.normal_W.dot(finger.force_W);
    const double across = finger.normal_W.cross(finger.force_W).norm();
    const double left = half_angle - std::atan2(across, along);
    margin = margin ? std::min(*margin, left) : left;
  }
  return margin;
}

std::vector<StepMeasures> MeasureSteps(const Report& report) {
  std::vector<StepMeasures> all;
  for (const ReportStep& step : report.steps) {
    StepMeasures& measures = all.emplace_back();
    if (!step.skipped && step.check.required) {
      measures.margin_deg = Degrees(report.half_angle - step.check.required->upper);
    }
    if (!step.skipped && step.replay) AddReplay(report, *step.replay, measures);
  }
  return all;
}

}  // namespace regrasp
