#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/plan/plan.h"
#include "report/markup.h"
#include "report/page/step_measures.h"
#include "report/report.h"

namespace regrasp::report {

/// A line per entry of a report: what happens, what friction it needs and has left, how far things
/// moved in the replay, and the verdict; with a note that says what the columns are.
/// @param measures  of each entry (MeasureSteps).
/// @param anchors   of each entry: the id of its picture in the page, empty where there is none.
[[nodiscard]] std::vector<Element> MakeStepTable(const Report& report, const plan::Plan& plan,
                                                 const std::vector<StepMeasures>& measures,
                                                 const std::vector<std::string>& anchors);

/// Of a single grasp: what friction each finger needs; empty where that is not told.
[[nodiscard]] std::vector<Element> MakeFingerTable(const Report& report);

}  // namespace regrasp::report
