#include "report/page/findings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/base/angle.h"
#include "planner/base/markup.h"
#include "report/page/quantity.h"
#include "report/page/step_plot.h"
#include "report/stress_table.h"

namespace regrasp {
namespace {

constexpr char kNothing[] = "–";

std::string Cell(const std::string& text) {
  return Element("td", "class=\"number\"", EscapeMarkup(text));
}

std::string Row(const std::string& cells) { return Element("tr", "", cells) + "\n"; }

std::string Table(const std::vector<std::string>& names, const std::string& rows) {
  std::string head;
  for (const std::string& name : names) {
    head += Element("th", "scope=\"col\" class=\"number\"", EscapeMarkup(name));
  }
  return Element("div", "class=\"scroll\"",
                 Element("table", "",
                         Element("thead", "", Element("tr", "", head)) +
                             Element("tbody", "", "\n" + rows))) +
         "\n";
}

std::string Note(std::string_view text) {
  return Element("p", "class=\"note\"", EscapeMarkup(text)) + "\n";
}

/// The steps that were replayed.
std::vector<const ReportStep*> Replayed(const Report& report) {
  std::vector<const ReportStep*> steps;
  for (const ReportStep& step : report.steps) {
    if (step.replay && !step.skipped) steps.push_back(&step);
  }
  return steps;
}

std::string Disagreements(const Report& report) {
  std::string items;
  for (const ReportStep& step : report.steps) {
    if (!step.disagreement) continue;
    const Disagreement& found = *step.disagreement;
    const char* what = found.between == Between::kReplayFails
                           ? "the analysis passes, the replay fails. "
                       : found.between == Between::kAnalysisFails
                           ? "the replay passes, the analysis fails. "
                           : "adapted forces resist the shake, a fixed squeeze does not. ";
    items += Element("li", "",
                     EscapeMarkup("Step " + std::to_string(step.check.index) + ": " + what +
                                  "Likely cause: " + found.text + ".")) +
             "\n";
  }
  if (items.empty()) return "";
  return Element("h2", "", "Disagreements") + "\n" + Element("ul", "", "\n" + items) + "\n";
}

std::string Margin(const FingerMargins& margins) {
  const auto least = SmallestMargin(margins);
  if (!least || !std::isfinite(*least)) return kNothing;
  return DegreesText(Degrees(*least)) + " (finger " +
         std::to_string(FingerOfSmallestMargin(margins)) + ")";
}

std::string FixedVerdict(const ReportStep& step) {
  const Reason reason = step.replay->fixed->reason;
  return reason == Reason::kNone ? "pass" : "fail: " + std::string(ReasonName(reason));
}

std::string WhatItTakes(const Report& report) {
  const auto steps = Replayed(report);
  if (steps.empty()) return "";
  const bool both = std::ranges::any_of(
      steps, [](const ReportStep* step) { return step->replay->adapted && step->replay->fixed; });
  std::string rows;
  for (const ReportStep* step : steps) {
    const int weakest = WeakestOf(step->needs);
    std::string cells = Cell(std::to_string(step->check.index));
    cells += Cell(weakest < 0 ? kNothing : std::to_string(step->needs[weakest].finger));
    cells +=
        Cell(weakest < 0 ? kNothing : DegreesText(Degrees(step->needs[weakest].friction.required)));
    cells += Cell(Margin(step->replay->rest_margins)) + Cell(Margin(step->replay->shake_margins));
    if (both) cells += Cell(step->replay->fixed ? FixedVerdict(*step) : kNothing);
    rows += Row(cells);
  }
  std::vector<std::string> names = {"Step", "Weakest finger", "Needs alone", "Least margin at rest",
                                    "Least margin in shakes"};
  if (both) names.emplace_back("Fixed squeeze");
  return Element("h2", "", "What it takes") + "\n" + Table(names, rows) +
         Note(
             "Weakest finger: the one whose own friction may fall least while all others keep "
             "theirs; it needs this half-angle alone, none where the grasp does without it. Least "
             "margin: the friction half-angle less the largest angle between a finger’s force and "
             "its normal, as the replay measured it.");
}

std::optional<double> Least(const ReportStep& step, double DirectionStress::*route) {
  if (!step.replay || step.skipped || step.replay->stress.empty()) return std::nullopt;
  return 100 * std::ranges::min(step.replay->stress, {}, route).*route;
}

std::string StressPlot(const Report& report) {
  StepPlot plot;
  plot.title = "The largest push that each rest resists in its weakest direction";
  plot.y_axis = "% of the squeeze";
  plot.series = {{"replay", {}, PlotMark::kDisc}, {"analysis", {}, PlotMark::kRing}};
  for (const ReportStep& step : report.steps) {
    plot.series[0].values.push_back(Least(step, &DirectionStress::replay));
    plot.series[1].values.push_back(Least(step, &DirectionStress::analysis));
  }
  plot.limit = PlotLimit{100 * report.settings->shake, "shake", false};
  const std::string caption =
      Element("b", "", "The weakest direction of each rest.") +
      " The largest push that is resisted, as the replay found it and by analysis.";
  return Element("div", "class=\"plots\"",
                 Element("figure", "", FormatStepPlot(plot) + Element("figcaption", "", caption))) +
         "\n";
}

std::string Stress(const Report& report) {
  if (!FindWeakestPush(report)) return "";
  std::vector<std::string> names = {"Step"};
  for (const Push& push : PushDirections(report.dimension)) names.push_back(PushName(push));
  std::string rows;
  for (const ReportStep* step : Replayed(report)) {
    if (step->replay->stress.empty()) continue;
    std::string cells = Cell(std::to_string(step->check.index));
    for (const DirectionStress& stress : step->replay->stress) {
      cells += Cell(NumberText(100 * stress.replay) + " | " + NumberText(100 * stress.analysis));
    }
    rows += Row(cells);
  }
  return Element("h2", "", "The largest push") + "\n" +
         (report.steps.size() > 1 ? StressPlot(report) : "") + Table(names, rows) +
         Note(
             "In percent of the squeeze, of a turn over half the diameter: the largest that each "
             "rest stood in the replay | that forces inside the cones balance, by analysis.");
}

}  // namespace

std::string FormatFindings(const Report& report) {
  return Disagreements(report) + WhatItTakes(report) + Stress(report);
}

}  // namespace regrasp
