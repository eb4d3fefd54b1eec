#pragma once

#include <vector>

#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the section of report.html with the findings, as elements; empty without findings.
/// The section lists disagreements between analysis, replay and fixed grasp force with their likely
/// cause. One line per step has the required friction, the weakest finger and the force margins. If
/// the report has resisted wrenches, they follow as a table and, for a plan with steps, as a plot.
[[nodiscard]] std::vector<Element> MakeFindings(const Report& report);

}  // namespace regrasp::report
