#pragma once

#include <span>
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

/// Return object, planner, friction, the weakest step or finger, and trials as names and values.
/// @param measures  measures of each entry (MeasureSteps).
[[nodiscard]] Element MakeFacts(const Report& report, const std::vector<StepMeasures>& measures);

/// Return a collapsed section with the settings of the replay, if there was one, the program and
/// its command, and the digests of the files.
[[nodiscard]] Element MakeSettings(const Report& report);

/// Return the section on disagreements between analysis, replays and engines, each with its likely
/// cause; empty without disagreements.
[[nodiscard]] std::vector<Element> MakeDisagreements(const Report& report);

/// Names of fingers by index; other fingers have their number.
using FingerNames = std::span<const std::string>;

/// Return the sections of report.html with the findings, as elements; empty without findings.
/// One line per step has the required friction, the weakest finger and the force margins. If
/// the report has resisted wrenches, they follow as a table and, for a plan with steps, as a plot.
/// The last section has the limits that a replay by a hand assumes.
[[nodiscard]] std::vector<Element> MakeFindings(const Report& report, FingerNames names = {});

/// Return the section on the conditions of a report: a bar chart with one bar per condition, and a
/// table. The length of a bar is the tolerance margin. Empty without conditions.
[[nodiscard]] std::vector<Element> MakeConditionSection(const Report& report);

/// Return the section on the goals of a plan for a hand; empty without goals.
[[nodiscard]] std::vector<Element> MakeGoalSection(const Report& report);

/// Make the section with the results of a hand replay in each engine; empty for other replays.
[[nodiscard]] std::vector<Element> MakeEngineSection(const Report& report);

}  // namespace regrasp::report
