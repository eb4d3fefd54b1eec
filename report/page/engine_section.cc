#include "report/page/engine_section.h"

#include <string>

#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "report/page/step_table.h"
#include "sim/validation/engine_results.h"

namespace regrasp::report {

std::vector<Element> MakeEngineSection(const Report& report) {
  const std::vector<validation::EngineResult> results = validation::EngineResultsOf(report);
  if (results.empty()) return {};
  std::vector<Element> head = {HeadCell("Engine", "")};
  for (const Element& cell : HeadCells({"Fails in step", "Off by", "and by", "Margin"})) {
    head.push_back(cell);
  }
  head.push_back(HeadCell("Verdict", ""));
  std::vector<Element> rows;
  for (const validation::EngineResult& result : results) {
    Element row("tr", result.passed ? Attributes() : Attributes{{"class", "fail"}});
    row.Add(Element("td", {}, result.engine));
    row.Add(NumberCell(result.passed ? "–" : std::to_string(result.failed)));
    row.Add(NumberCell(LengthText(result.off_m)));
    row.Add(NumberCell(FormatDegrees(Degrees(result.off_rad))));
    row.Add(NumberCell(NumberText(result.margin)));
    row.Add(Element("td", {}, result.passed ? "pass" : result.detail));
    rows.push_back(row);
  }
  return {Element("h2", {}, "Engines"), ScrolledTable(head, rows)};
}

}  // namespace regrasp::report
