#pragma once

#include <vector>

#include "report/markup.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the section on the goals of a plan for a hand; empty without goals.
[[nodiscard]] std::vector<Element> MakeGoalSection(const Report& report);

}  // namespace regrasp::report
