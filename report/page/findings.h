#pragma once

#include <vector>

#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// The part of report.html on what the examinations of a plan found, as elements: where analysis,
/// replay and fixed squeeze disagree, with the likely cause; a line per step on what it takes, the
/// weakest finger and the margins of forces to their cones; and, where the report has them, the
/// largest pushes, as a table and, of a plan with steps, as a plot. Empty where there is nothing.
[[nodiscard]] std::vector<Element> MakeFindings(const Report& report);

}  // namespace regrasp::report
