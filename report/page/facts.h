#pragma once

#include <vector>

#include "report/markup.h"
#include "report/page/step_measures.h"
#include "report/report.h"

namespace regrasp::report {

/// Names and values of what was validated and how, beside each other: files and their digests,
/// friction, the weakest step or finger, trials, and the settings of the replay where there was
/// one.
/// @param measures  of each entry (MeasureSteps).
[[nodiscard]] Element MakeFacts(const Report& report, const std::vector<StepMeasures>& measures);

}  // namespace regrasp::report
