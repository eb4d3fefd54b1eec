#pragma once

#include <vector>

#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the section on the conditions of a report: a bar chart with one bar per condition, and a
/// table. The length of a bar is the tolerance margin. Empty without conditions.
[[nodiscard]] std::vector<Element> MakeConditionSection(const Report& report);

}  // namespace regrasp::report
