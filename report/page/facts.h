#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"
#include "report/page/step_table.h"
#include "report/report.h"

namespace regrasp::report {

/// Names and values in two columns on a page.
class FactList {
 public:
  /// @param style  class of the style sheet, "digest" for long lines; may be empty.
  void Add(std::string_view name, std::string_view value, const std::string& style = "") {
    const Attributes attributes = style.empty() ? Attributes() : Attributes{{"class", style}};
    facts_.emplace_back("div", attributes, Element("dt", {}, name), Element("dd", {}, value));
  }
  [[nodiscard]] Element Make() const { return Element("dl", {{"class", "facts"}}, facts_); }

 private:
  std::vector<Element> facts_;
};

/// Return the settings and inputs of a validation as names and values.
/// They are files with digests, friction, the weakest step or finger, trials, and the settings of
/// the replay if there was one.
/// @param measures  measures of each entry (MeasureSteps).
[[nodiscard]] Element MakeFacts(const Report& report, const std::vector<StepMeasures>& measures);

/// Return the section of report.html with the findings, as elements; empty without findings.
/// The section lists disagreements between analysis, replay and fixed grasp force with their likely
/// cause. One line per step has the required friction, the weakest finger and the force margins. If
/// the report has resisted wrenches, they follow as a table and, for a plan with steps, as a plot.
[[nodiscard]] std::vector<Element> MakeFindings(const Report& report);

/// Return the section on the conditions of a report: a bar chart with one bar per condition, and a
/// table. The length of a bar is the tolerance margin. Empty without conditions.
[[nodiscard]] std::vector<Element> MakeConditionSection(const Report& report);

/// Return the section on the goals of a plan for a hand; empty without goals.
[[nodiscard]] std::vector<Element> MakeGoalSection(const Report& report);

/// Make the section with the results of a hand replay in each engine; empty for other replays.
[[nodiscard]] std::vector<Element> MakeEngineSection(const Report& report);

}  // namespace regrasp::report
