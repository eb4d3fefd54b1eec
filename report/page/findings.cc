#include "report/page/findings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/base/number.h"
#include "report/page/step_plot.h"
#include "report/page/step_table.h"
#include "report/report_table.h"
#include "sim/measure/disturbance.h"
#include "sim/measure/weakest_finger.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::report {
namespace {

constexpr char kNoFinding[] = "–";

/// Return the steps that were replayed.
std::vector<const ReportStep*> Replayed(const Report& report) {
  std::vector<const ReportStep*> steps;
  for (const ReportStep& step : report.steps) {
    if (step.replay && !step.skipped) steps.push_back(&step);
  }
  return steps;
}

std::string_view BetweenText(sim::Between between) {
  switch (between) {
    case sim::Between::kReplayFails:
      return "the analysis passes, the replay fails";
    case sim::Between::kAnalysisFails:
      return "the replay passes, the analysis fails";
    case sim::Between::kFixedFails:
      return "adapted forces resist the disturbance, a fixed grasp force does not";
    case sim::Between::kOdeFails:
      return "MuJoCo passes, ODE fails";
    case sim::Between::kOdePasses:
      return "ODE passes, MuJoCo fails";
  }
  return "";
}

std::vector<Element> Disagreements(const Report& report) {
  std::vector<Element> items;
  for (const ReportStep& step : report.steps) {
    for (const auto& found : {step.disagreement, step.engines}) {
      if (!found) continue;
      items.emplace_back("li", Attributes(),
                         "Step " + std::to_string(step.check.index) + ": " +
                             std::string(BetweenText(found->between)) + ". " +
                             Capitalized(sim::LikelyCauseText(*found)) + ".");
    }
  }
  if (items.empty()) return {};
  return {Element("h2", {}, "Disagreements"), Element("ul", {}, items)};
}

std::string Margin(const sim::FingerMargins& margins) {
  const auto least = sim::SmallestMargin(margins);
  if (!least || !std::isfinite(*least)) return kNoFinding;
  return FormatDegrees(Degrees(*least)) + " (finger " +
         std::to_string(sim::FingerOfSmallestMargin(margins)) + ")";
}

Element RequirementsRow(const ReportStep& step, bool both) {
  const std::optional<sim::NeedOfFinger>& need = step.weakest_finger;
  Element row("tr");
  row.Add(NumberCell(std::to_string(step.check.index)));
  row.Add(NumberCell(need ? std::to_string(need->finger) : kNoFinding));
  row.Add(NumberCell(need ? FormatRequiredDegrees(Degrees(need->friction.required)) + "°"
                          : kNoFinding));
  row.Add(NumberCell(Margin(step.replay->static_margins)));
  row.Add(NumberCell(Margin(step.replay->disturbance_margins)));
  if (both)
    row.Add(NumberCell(step.replay->fixed ? ReasonText(step.replay->fixed->reason) : kNoFinding));
  return row;
}

std::vector<Element> WhatItTakes(const Report& report) {
  const auto steps = Replayed(report);
  if (steps.empty()) return {};
  const bool both = std::ranges::any_of(
      steps, [](const ReportStep* step) { return step->replay->adapted && step->replay->fixed; });
  std::vector<Element> head =
      HeadCells({"Step", "Weakest finger", "Needs alone", "Least margin in static grasp",
                 "Least margin under disturbances"});
  std::vector<Element> rows;
  if (both) head.push_back(HeadCell("Fixed grasp force"));
  for (const ReportStep* step : steps) rows.push_back(RequirementsRow(*step, both));
  return {
      Element("h2", {}, "What it takes"), ScrolledTable(head, rows),
      Note("Weakest finger: the one whose own friction may fall least while all others keep "
           "theirs; it needs this friction angle alone, none if the grasp does not need it. Least "
           "margin: the friction angle less the largest angle between a finger’s force and "
           "its normal, as the replay measured it.")};
}

std::optional<double> Least(const ReportStep& step, double sim::ResistedWrench::*route) {
  if (!step.replay || step.skipped || step.replay->resisted_wrench.empty()) return std::nullopt;
  return 100 * std::ranges::min(step.replay->resisted_wrench, {}, route).*route;
}

Element ResistedWrenchPlot(const Report& report) {
  StepPlot plot;
  plot.title = "Largest disturbance that each static grasp resists in its weakest direction";
  plot.y_axis = "% of the grasp force";
  plot.series = {{"replay", {}, PlotMark::kDisc}, {"analysis", {}, PlotMark::kRing}};
  for (const ReportStep& step : report.steps) {
    plot.series[0].values.push_back(Least(step, &sim::ResistedWrench::replay));
    plot.series[1].values.push_back(Least(step, &sim::ResistedWrench::analysis));
  }
  plot.limit = PlotLimit{100 * report.settings->disturbance_ratio, "shake", false};
  return Element(
      "div", {{"class", "plots"}},
      Figure({}, DrawStepPlot(plot), "The weakest direction of each static grasp.",
             "The largest disturbance that is resisted, in the replay and by analysis."));
}

Element ResistedWrenchRow(const ReportStep& step) {
  Element row("tr", {}, NumberCell(std::to_string(step.check.index)));
  for (const sim::ResistedWrench& resisted_wrench : step.replay->resisted_wrench) {
    row.Add(NumberCell(NumberText(100 * resisted_wrench.replay) + " | " +
                       NumberText(100 * resisted_wrench.analysis)));
  }
  return row;
}

std::vector<Element> ResistedWrenches(const Report& report) {
  if (!FindWeakestDisturbance(report)) return {};
  std::vector<Element> head = {HeadCell("Step")};
  for (const sim::Disturbance& disturbance : sim::DisturbanceDirections(report.dimension)) {
    head.push_back(HeadCell(sim::DisturbanceName(disturbance)));
  }
  std::vector<Element> rows;
  for (const ReportStep* step : Replayed(report)) {
    if (!step->replay->resisted_wrench.empty()) rows.push_back(ResistedWrenchRow(*step));
  }
  std::vector<Element> found = {Element("h2", {}, "Largest disturbance")};
  if (report.steps.size() > 1) found.push_back(ResistedWrenchPlot(report));
  found.push_back(ScrolledTable(head, rows));
  found.push_back(Note(
      "In percent of the grasp force, torques over half the diameter: the largest that each "
      "static grasp resisted in the replay | that forces inside the cones balance, by analysis."));
  return found;
}

Element LimitsRow(const sim::DriveLimits& limit) {
  Element row("tr", {}, NumberCell(std::to_string(limit.finger)));
  row.Add(Element("td", {}, limit.joint));
  row.Add(Element("td", {}, limit.actuator));
  row.Add(NumberCell(std::isfinite(limit.torque_Nm) ? NumberText(limit.torque_Nm) : "unknown"));
  row.Add(NumberCell(limit.control ? NumberText(limit.control->front()) + " to " +
                                         NumberText(limit.control->back())
                                   : "none"));
  row.Add(NumberCell(FormatDegrees(Degrees(limit.lower_rad)) + " to " +
                     FormatDegrees(Degrees(limit.upper_rad))));
  return row;
}

/// Return the limits that a replay by a hand assumes.
std::vector<Element> Limits(const Report& report) {
  if (!report.settings || !report.settings->hand) return {};
  const std::vector<sim::DriveLimits>& limits = report.settings->hand->limits;
  if (limits.empty()) return {};
  std::vector<Element> rows;
  for (const sim::DriveLimits& limit : limits) rows.push_back(LimitsRow(limit));
  return {Element("h2", {}, "Limits that the verdict relies on"),
          ScrolledTable(HeadCells({"Finger", "Joint", "Actuator", "Torque, N·m", "Control range",
                                   "Joint range"}),
                        rows),
          Note("As the hand's model gives them. If it gives no force limit, the replay takes the "
               "actuator's strength as unlimited. A control is kept in its range.")};
}

}  // namespace

std::vector<Element> MakeFindings(const Report& report) {
  std::vector<Element> findings = Disagreements(report);
  for (const auto& part : {WhatItTakes(report), ResistedWrenches(report), Limits(report)}) {
    findings.insert(findings.end(), part.begin(), part.end());
  }
  return findings;
}

}  // namespace regrasp::report
