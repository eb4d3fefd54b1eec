#include "report/goal_table.h"

#include "planner/base/number.h"
#include "report/report_json.h"

namespace regrasp::report {

namespace {

constexpr char kNone[] = "-";

std::string DistanceText(const validation::GoalReport& goal, const plan::GoalDistance& distance) {
  const std::string angle = FormatDegrees(Degrees(distance.angle));
  return goal.is_facing ? angle : FormatLength(distance.length) + ", " + angle;
}

}  // namespace

Json GoalsJson(const std::vector<validation::GoalReport>& goals) {
  Json json = Json::array();
  for (const validation::GoalReport& goal : goals) {
    json.push_back({{"name", TextOrNull(goal.name)},
                    {"step", int{goal.step}},
                    {"verdict", std::string(VerdictName(goal.verdict))},
                    {"off_m", goal.is_facing ? Json(nullptr) : Json(goal.off.length)},
                    {"off_deg", Degrees(goal.off.angle)},
                    {"tolerance_m", goal.is_facing ? Json(nullptr) : Json(goal.allowed.length)},
                    {"tolerance_deg", Degrees(goal.allowed.angle)}});
  }
  return json;
}

TextRow GoalCells(const validation::GoalReport& goal) {
  return {goal.name.empty() ? kNone : goal.name, std::to_string(goal.step),
          DistanceText(goal, goal.off), DistanceText(goal, goal.allowed),
          std::string(VerdictName(goal.verdict))};
}

std::string FormatGoalTable(const Report& report) {
  if (report.goals.empty()) return "";
  std::vector<TextRow> rows = {{"goal", "step", "off", "tolerance", "verdict"}};
  for (const validation::GoalReport& goal : report.goals) rows.push_back(GoalCells(goal));
  return FormatRows(rows);
}

}  // namespace regrasp::report
