#include "report/page/condition_section.h"

#include <algorithm>
#include <string>

#include "planner/base/number.h"
#include "report/condition_table.h"
#include "report/page/step_table.h"

namespace regrasp::report {
namespace {

// Sizes of the bar chart, in its own units.
constexpr int kBarHeight = 14;
constexpr int kRowHeight = 20;
constexpr int kLabelWidth = 170;
constexpr int kLimitWidth = 240;  ///< length of a bar at the limit
constexpr int kChartWidth = 640;
constexpr int kTopHeight = 24;
/// Longest bar, as a share of the limit.
constexpr double kMostShare = 1.8;

std::string ClassOf(const sim::ConditionResult& result) {
  if (!result.applies) return "skipped";
  if (result.passed()) return "pass";
  return result.ends_within ? "partly" : "fail";
}

Element BarText(double x, double y, const std::string& text, const std::string& style) {
  return Element("text", {{"x", FormatShort(x)}, {"y", FormatShort(y)}, {"class", style}}, text);
}

Element ConditionBars(const sim::ConditionSummary& summary) {
  const auto count = static_cast<int>(summary.results.size());
  const int height = kTopHeight + count * kRowHeight;
  Element svg("svg",
              {{"role", "img"},
               {"aria-label", "Largest deviation under each condition, over its limit"},
               {"viewBox", "0 0 " + std::to_string(kChartWidth) + " " + std::to_string(height)}});
  const int limit = kLabelWidth + kLimitWidth;
  for (int i = 0; i < count; ++i) {
    const sim::ConditionResult& result = summary.results[i];
    const int top = kTopHeight + i * kRowHeight;
    const double used = result.applies ? std::clamp(1 - result.margin, 0.0, kMostShare) : 0;
    const double width = std::max(1.0, kLimitWidth * used);
    svg.Add(BarText(0, top + kBarHeight - 3, result.condition.name, "label"));
    svg.Add(Element("rect", {{"x", std::to_string(kLabelWidth)},
                             {"y", std::to_string(top)},
                             {"width", FormatShort(width)},
                             {"height", std::to_string(kBarHeight)},
                             {"class", "bar " + ClassOf(result)}}));
    svg.Add(BarText(std::max<double>(kLabelWidth + width, limit) + 6, top + kBarHeight - 3,
                    result.applies ? std::string(plan::ReasonName(result.reason)) : "–", "label"));
  }
  svg.Add(Element("line", {{"x1", std::to_string(limit)},
                           {"x2", std::to_string(limit)},
                           {"y1", std::to_string(kTopHeight - 4)},
                           {"y2", std::to_string(height)},
                           {"class", "limit"}}));
  svg.Add(BarText(limit - 12, kTopHeight - 9, "limit", "limit"));
  return svg;
}

Element ConditionRow(const sim::ConditionResult& result) {
  const bool failed = result.applies && !result.passed();
  Element row("tr", failed ? Attributes{{"class", "fail"}} : Attributes());
  row.Add(Element("td", {}, result.condition.name));
  row.Add(Element("td", {}, result.condition.changes));
  row.Add(NumberCell(result.failed.valid() ? std::to_string(result.failed) : "–"));
  row.Add(NumberCell(result.applies ? LengthText(result.end_m) : "–"));
  row.Add(NumberCell(result.applies ? FormatDegrees(Degrees(result.end_rad)) : "–"));
  row.Add(NumberCell(result.ends_within ? "yes" : "no"));
  row.Add(NumberCell(result.applies ? NumberText(result.margin) : "–"));
  row.Add(Element("td", {}, ConditionVerdictText(result)));
  return row;
}

}  // namespace

std::vector<Element> MakeConditionSection(const Report& report) {
  if (!report.conditions) return {};
  std::vector<Element> head = {HeadCell("Condition", ""), HeadCell("Changes", "")};
  for (const Element& cell :
       HeadCells({"Fails in step", "End off by", "and by", "Within tolerance", "Margin"})) {
    head.push_back(cell);
  }
  head.push_back(HeadCell("Verdict", ""));
  std::vector<Element> rows;
  for (const sim::ConditionResult& result : report.conditions->results) {
    rows.push_back(ConditionRow(result));
  }
  return {Element("h2", {}, "Conditions"),
          Note("One replay under each condition, without disturbance tests: " +
               ConditionsShareText(*report.conditions) + "."),
          Figure({{"class", "conditions"}}, ConditionBars(*report.conditions),
                 "Largest deviation over its limit.",
                 "The bar is the largest deviation of object and fingertips in any step, as a "
                 "share of its limit, and the text the first reason to fail. A light bar failed "
                 "but ended within the tolerance."),
          ScrolledTable(head, rows)};
}

}  // namespace regrasp::report
