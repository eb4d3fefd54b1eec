#pragma once

#include "planner/base/json.h"
#include "report/report.h"

namespace regrasp::report {

/// The report as report.json has it, without its seal (FormatReportJson).
[[nodiscard]] Json ReportJson(const Report& report);

}  // namespace regrasp::report
