#pragma once

#include <string>
#include <vector>

#include "planner/base/json.h"
#include "planner/base/text_table.h"
#include "report/report.h"

namespace regrasp::report {

/// Return the member `goals` of report.json.
[[nodiscard]] Json GoalsJson(const std::vector<validation::GoalReport>& goals);

/// Return the cells of a goal: name, step, deviation, tolerance, verdict.
[[nodiscard]] TextRow GoalCells(const validation::GoalReport& goal);

/// Return a table with one row per goal; empty without goals.
[[nodiscard]] std::string FormatGoalTable(const Report& report);

}  // namespace regrasp::report
