#include "report/page/goal_section.h"

#include "report/goal_table.h"
#include "report/page/step_table.h"

namespace regrasp::report {

std::vector<Element> MakeGoalSection(const Report& report) {
  if (report.goals.empty()) return {};
  std::vector<Element> head;
  for (const char* name : {"Goal", "After step", "Off by", "Tolerance", "Verdict"}) {
    head.push_back(HeadCell(name, ""));
  }
  std::vector<Element> rows;
  for (const validation::GoalReport& goal : report.goals) {
    const bool failed = goal.verdict == Verdict::kFail;
    Element row("tr", failed ? Attributes{{"class", "fail"}} : Attributes());
    for (const std::string& cell : GoalCells(goal)) row.Add(Element("td", {}, cell));
    rows.push_back(std::move(row));
  }
  return {Element("h2", {}, "Goals"),
          Note("The planned pose of the object after each goal's step, relative to the middle of "
               "the goal set."),
          ScrolledTable(head, rows)};
}

}  // namespace regrasp::report
