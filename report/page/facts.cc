#include "report/page/facts.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "planner/base/number.h"
#include "report/goal_table.h"
#include "report/page/step_plot.h"
#include "report/page/step_table.h"
#include "report/report_table.h"
#include "sim/measure/disturbance.h"
#include "sim/validation/engine_results.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::report {

namespace {

/// Number of significant digits, as in NumberText.
constexpr int kQualityDigits = 3;

/// Class of values that need a line of their own.
constexpr char kLong[] = "digest";

void AddGrasp(const Report& report, FactList& facts) {
  const GraspReport& grasp = *report.grasp;
  const std::optional<grasp::RequiredFrictionAngle>& required = report.steps.front().check.required;
  facts.Add("Required friction",
            required ? FormatRequiredDegrees(Degrees(required->upper)) + "°" : "none is enough");
  if (grasp.fingers.empty()) return;
  facts.Add("Quality ε", grasp::QualityText(grasp.quality, kQualityDigits));
  facts.Add("Weakest", "finger " + std::to_string(grasp::WeakestFinger(grasp.fingers)));
}

void AddTrials(const sim::TrialSummary& trials, FactList& facts) {
  facts.Add("Trials", TrialsShareText(trials));
  const std::string failures = TrialsFailureText(trials);
  if (!failures.empty()) facts.Add("Trials that fail", failures);
  facts.Add("Noise", TrialsNoiseText(trials));
}

void AddSettings(const sim::ReplaySettings& settings, FactList& facts) {
  facts.Add("Diameter", LengthText(settings.diameter_m));
  facts.Add("Mass", NumberText(settings.mass_kg) + " kg");
  facts.Add("Grasp force", GraspForceText(settings));
  facts.Add("Disturbance", NumberText(100 * settings.disturbance_ratio) + " % of the grasp force");
  if (settings.protocol == sim::Protocol::kFixed) facts.Add("Protocol", "fixed grasp force");
  if (settings.hand) {
    const sim::HandTolerance& tolerance = settings.hand->tolerance;
    facts.Add("Replay", "by the hand's own actuators");
    facts.Add("Feedback", FeedbackText(settings.hand->sensing));
    facts.Add("Fingertips", settings.hand->tip == sim::TipShape::kBall
                                ? "spheres"
                                : "the model's own collision geometry");
    facts.Add("Tolerance", LengthText(tolerance.length_m) + ", " +
                               FormatDegrees(Degrees(tolerance.angle_rad)) + " off the plan");
    facts.Add("Limits", LimitsText(settings.hand->limits));
    return;
  }
  facts.Add("Tolerance", LengthText(settings.tolerance * settings.diameter_m));
}

/// Return the size and mass of the object, and the assumption about the unit of its file.
std::string SizeText(const Report& report) {
  if (!report.has_no_unit) return report.measures;
  return report.measures + "; no unit in the file, read as " +
         (report.scale == 1 ? "metres" : LengthText(report.scale) + " per unit");
}

}  // namespace

Element MakeFacts(const Report& report, const std::vector<StepMeasures>& measures) {
  FactList facts;
  facts.Add("Object", report.object_file + (report.dimension == 2 ? ", planar" : ", a solid"));
  if (!report.measures.empty()) facts.Add("Size", SizeText(report));
  if (!report.planner.empty()) facts.Add("Planner", report.planner);
  if (report.farthest_from_points) {
    facts.Add("Contacts", "at given points, at most " +
                              LengthText(*report.farthest_from_points * report.scale) + " off");
  }
  facts.Add("Friction", FormatDegrees(Degrees(report.friction_angle)) +
                            " (μ = " + NumberText(std::tan(report.friction_angle)) + ")");
  if (report.torsion > 0) {
    facts.Add("Soft fingers", "torsion " + LengthText(report.torsion * report.scale));
  }
  if (report.grasp) AddGrasp(report, facts);
  const plan::EntryIndex weakest = report.weakest_step();
  if (weakest.valid() && !report.grasp && report.steps_passed()) {
    facts.Add("Weakest", StepName(weakest) + ", " +
                             FormatDegrees(measures[weakest].margin_deg.value_or(0)) + " margin");
  }
  if (report.trials) AddTrials(*report.trials, facts);
  return facts.Make();
}

Element MakeSettings(const Report& report) {
  FactList settings;
  if (report.settings) AddSettings(*report.settings, settings);
  if (report.run && !report.run->program.empty()) {
    settings.Add("Program", report.run->program);
    if (!report.run->date.empty()) settings.Add("Validated on", report.run->date + " (UTC)");
    settings.Add("Command without output options", report.run->command, kLong);
  }
  settings.Add("Object, SHA-256", report.object_sha256, kLong);
  settings.Add(report.grasp ? "Grasp, SHA-256" : "Plan, SHA-256", report.plan_sha256, kLong);
  return Element("details", {}, Element("summary", {}, "Settings and digests"), settings.Make());
}

namespace {

const std::string kNoFinding = "–";

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

}  // namespace

std::vector<Element> MakeDisagreements(const Report& report) {
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

namespace {

/// Return the name of a finger, or "finger 2" if it has none.
std::string FingerText(FingerIndex finger, FingerNames names) {
  const std::string number = std::to_string(finger);
  return finger < static_cast<int>(names.size()) ? names[finger] : "finger " + number;
}

std::string Margin(const sim::FingerMargins& margins, FingerNames names) {
  const auto least = sim::SmallestMargin(margins);
  if (!least || !std::isfinite(*least)) return kNoFinding;
  // At the friction limit the margin is a rounding error, of either sign.
  constexpr double kSmallestShown_deg = 0.005;
  const double degrees = Degrees(*least);
  return FormatDegrees(std::abs(degrees) < kSmallestShown_deg ? 0 : degrees) + " (" +
         FingerText(sim::FingerOfSmallestMargin(margins), names) + ")";
}

/// A column of the table of required friction and force margins.
struct FindingColumn {
  std::string_view head;
  std::function<std::string(const ReportStep&)> text;
};

std::vector<FindingColumn> FindingColumns(FingerNames names) {
  return {
      {"Step", [](const ReportStep& step) { return std::to_string(step.check.index); }},
      {"Weakest finger",
       [names](const ReportStep& step) {
         return step.weakest_finger ? FingerText(step.weakest_finger->finger, names) : kNoFinding;
       }},
      {"Required alone",
       [](const ReportStep& step) {
         const auto& need = step.weakest_finger;
         return need ? FormatRequiredDegrees(Degrees(need->friction.required)) + "°" : kNoFinding;
       }},
      {"Least force margin, static grasp",
       [names](const ReportStep& step) { return Margin(step.replay->static_margins, names); }},
      {"Least force margin, disturbances",
       [names](const ReportStep& step) { return Margin(step.replay->disturbance_margins, names); }},
      {"Fixed grasp force", [](const ReportStep& step) {
         const sim::StepReplay& replay = *step.replay;
         return replay.adapted && replay.fixed ? ReasonText(replay.fixed->reason) : kNoFinding;
       }}};
}

/// Columns without a value are omitted.
std::vector<Element> WhatItTakes(const Report& report, FingerNames names) {
  const auto steps = Replayed(report);
  if (steps.empty()) return {};
  std::vector<Element> head;
  std::vector<Element> rows(steps.size(), Element("tr"));
  for (const FindingColumn& column : FindingColumns(names)) {
    std::vector<std::string> texts;
    for (const ReportStep* step : steps) texts.push_back(column.text(*step));
    if (std::ranges::count(texts, kNoFinding) == std::ssize(texts)) continue;
    head.push_back(HeadCell(column.head));
    for (std::size_t i = 0; i < texts.size(); ++i) rows[i].Add(NumberCell(texts[i]));
  }
  if (head.size() == 1) return {};
  // The replay of a hand has no force margins.
  const bool has_margins = std::ranges::any_of(steps, [](const ReportStep* step) {
    return sim::SmallestMargin(step->replay->static_margins).has_value();
  });
  const std::string note =
      "Weakest finger: the finger whose friction angle can decrease least while all others keep "
      "theirs, to the angle that is required alone.";
  const std::string margins =
      " Force margin: the friction angle minus the largest angle between a finger’s force and its "
      "normal in the replay.";
  return {
      Element("h2", {}, has_margins ? "Required friction and force margins" : "Required friction"),
      ScrolledTable(head, rows, "narrow"), Note(note + (has_margins ? margins : ""))};
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
  plot.limit = PlotLimit{100 * report.settings->disturbance_ratio, "disturbance", false};
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

// Columns of the table of limits after finger and joint.
constexpr char kActuator[] = "Actuator";
constexpr char kTorque[] = "Torque, N·m";
constexpr char kControl[] = "Control range";
constexpr char kJointRange[] = "Joint range";

/// Return "−45° to 90°".
std::string RangeText(double lower, double upper, const std::string& unit) {
  const auto text = [&](double value) {
    return (value < 0 ? "\u2212" : "") + NumberText(std::abs(value)) + unit;
  };
  return text(lower) + " to " + text(upper);
}

Element LimitsRow(const sim::DriveLimits& limit, FingerNames names) {
  const std::string torque =
      std::isfinite(limit.torque_Nm) ? NumberText(limit.torque_Nm) : "unknown";
  const std::string control =
      limit.control ? RangeText(limit.control->front(), limit.control->back(), "") : "none";
  Element actuator("td", {{"data-name", kActuator}}, limit.actuator);
  return Element(
      "tr", {}, Element("td", {}, FingerText(limit.finger, names)), Element("td", {}, limit.joint),
      actuator, NamedCell(kTorque, torque), NamedCell(kControl, control),
      NamedCell(kJointRange, RangeText(Degrees(limit.lower_rad), Degrees(limit.upper_rad), "°")));
}

/// Return the limits that a replay by a hand assumes, folded, because a hand has many joints.
std::vector<Element> Limits(const Report& report, FingerNames names) {
  if (!report.settings || !report.settings->hand) return {};
  const std::vector<sim::DriveLimits>& limits = report.settings->hand->limits;
  if (limits.empty()) return {};
  std::vector<Element> rows;
  for (const sim::DriveLimits& limit : limits) rows.push_back(LimitsRow(limit, names));
  std::vector<Element> head;
  for (const char* name : {"Finger", "Joint", kActuator}) head.push_back(HeadCell(name, ""));
  for (const char* name : {kTorque, kControl, kJointRange}) head.push_back(HeadCell(name));
  const std::string joints =
      std::to_string(limits.size()) + (limits.size() == 1 ? " joint" : " joints");
  return {Element("details", {},
                  Element("summary", {}, "Limits that the verdict relies on: " + joints),
                  ScrolledTable(head, rows, "pairs"),
                  Note("As the hand's model gives them. If it gives no force limit, the replay "
                       "takes the actuator's strength as unlimited. A control is kept in its "
                       "range."))};
}

}  // namespace

std::vector<Element> MakeFindings(const Report& report, FingerNames names) {
  std::vector<Element> findings;
  for (const auto& part :
       {WhatItTakes(report, names), ResistedWrenches(report), Limits(report, names)}) {
    findings.insert(findings.end(), part.begin(), part.end());
  }
  return findings;
}

namespace {

// Sizes of the bar chart, in its own units.
constexpr int kBarHeight = 14;
constexpr int kRowHeight = 20;
constexpr int kLabelWidth = 170;
constexpr int kLimitWidth = 240;  ///< length of a bar at the limit
constexpr int kChartWidth = 760;  ///< with the longest name of a reason
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

/// Return the changes of a condition as text: "pose_delay_s 0.05, pose_rate_Hz 30".
std::string ChangesText(const sim::HandCondition& condition) {
  const Json changes = ParseJson(condition.changes, condition.name);
  std::string text;
  for (const auto& [name, value] : changes.items()) {
    text += (text.empty() ? "" : ", ") + name + " " +
            (value.is_string() ? value.get<std::string>() : value.dump());
  }
  return text;
}

Element ConditionRow(const sim::ConditionResult& result) {
  const bool failed = result.applies && !result.passed();
  Element row("tr", failed ? Attributes{{"class", "fail"}} : Attributes());
  row.Add(Element("td", {{"class", "option"}}, result.condition.name));
  row.Add(Element("td", {}, ConditionVerdictText(result)));
  row.Add(NumberCell(result.failed.valid() ? std::to_string(result.failed) : "–"));
  row.Add(NumberCell(result.applies ? LengthText(result.end_m) : "–"));
  row.Add(NumberCell(result.applies ? FormatDegrees(Degrees(result.end_rad)) : "–"));
  row.Add(NumberCell(result.ends_within ? "yes" : "no"));
  row.Add(NumberCell(result.applies ? NumberText(result.margin) : "–"));
  row.Add(Element("td", {}, ChangesText(result.condition)));
  return row;
}

}  // namespace

std::vector<Element> MakeConditionSection(const Report& report) {
  if (!report.conditions) return {};
  std::vector<Element> head = {HeadCell("Condition", ""), HeadCell("Verdict", "")};
  for (const Element& cell :
       HeadCells({"Fails in step", "End off by", "and by", "Within tolerance", "Margin"})) {
    head.push_back(cell);
  }
  head.push_back(HeadCell("Changes", ""));
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
