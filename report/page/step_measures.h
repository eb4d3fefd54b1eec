#pragma once

#include <optional>
#include <vector>

#include "report/report.h"

namespace regrasp::report {

/// Numbers of each entry of a report, none where it has none; what plots and tables show.
struct StepMeasures {
  /// Largest |Δx| + R |Δrotation| of the object, metres: what the tolerance is about.
  std::optional<double> moved_m;
  std::optional<double> slip_m;  ///< the largest of a holding finger
  /// Friction half-angle minus the required one, degrees; negative where the step fails for it.
  std::optional<double> margin_deg;
  /// Friction half-angle minus the largest angle between the force of a holding finger and its
  /// normal at rest after the step, degrees.
  std::optional<double> rest_margin_deg;
};

[[nodiscard]] std::vector<StepMeasures> MeasureSteps(const Report& report);

}  // namespace regrasp::report
