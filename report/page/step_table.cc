#include "report/page/step_table.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/base/number.h"
#include "render/picture/caption.h"
#include "report/page/step_plot.h"
#include "sim/world/motion_monitor.h"

namespace regrasp::report {

Element HeadCell(std::string_view name, std::string_view style) {
  return Element("th", {{"scope", "col"}, {"class", std::string(style)}}, name);
}

std::vector<Element> HeadCells(const std::vector<std::string_view>& names) {
  std::vector<Element> cells;
  for (const std::string_view name : names) cells.push_back(HeadCell(name));
  return cells;
}

Element NumberCell(std::string_view text) { return Element("td", {{"class", "number"}}, text); }

namespace {

constexpr char kNoStepValue[] = "–";

}  // namespace

Element NamedCell(std::string_view name, std::string_view text) {
  const char* style = text == kNoStepValue ? "number none" : "number";
  return Element("td", {{"class", style}, {"data-name", std::string(name)}}, text);
}

Element ScrolledTable(const std::vector<Element>& head, const std::vector<Element>& rows,
                      std::string_view style) {
  const Attributes attributes =
      style.empty() ? Attributes() : Attributes{{"class", std::string(style)}};
  const Element table("table", attributes, Element("thead", {}, Element("tr", {}, head)),
                      Element("tbody", {}, rows));
  return Element("div", {{"class", "scroll"}}, table);
}

Element Figure(const Attributes& attributes, const Element& picture, std::string_view name,
               const std::string& text) {
  return Element("figure", attributes, picture,
                 Element("figcaption", {}, Element("b", {}, name), " " + text));
}

Element Note(std::string_view text) { return Element("p", {{"class", "note"}}, text); }

namespace {

constexpr int kDigits = 3;

/// Limits from which numbers are written with a power of ten.
constexpr double kPlainFrom = 1e-3;
constexpr double kPlainTo = 1e6;

/// Lengths below the size of an atom are meaningless.
constexpr double kShortest_m = 1e-10;

constexpr char kNothing[] = "–";

/// Return the number without trailing zeros and without a trailing point.
std::string WithoutZeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::string NumberText(double value) {
  if (!std::isfinite(value)) return kNothing;
  if (value == 0) return "0";
  const double size = std::abs(value);
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (size >= kPlainFrom && size < kPlainTo) {
    return WithoutZeros(FormatFixed(value, std::max(0, kDigits - 1 - exponent)));
  }
  const double mantissa = value / std::pow(10.0, exponent);
  return WithoutZeros(FormatFixed(mantissa, kDigits - 1)) + "\u00a0×\u00a0" +
         FormatPowerOfTen(exponent);
}

std::string LengthText(double metres) {
  if (!std::isfinite(metres)) return kNothing;
  if (metres < kShortest_m) return "0";
  std::string text = FormatLength(metres);
  return text.replace(text.find(' '), 1, "\u00a0");
}

namespace {

/// An unstable replay can have infinite values.
std::optional<double> IfFinite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void AddReplay(const sim::StepReplay& replay, StepMeasures& measures) {
  measures.moved_m = IfFinite(replay.moved_m);
  measures.slip_m = IfFinite(replay.slip_m);
  if (const auto margin = sim::SmallestMargin(replay.static_margins)) {
    measures.static_margin_deg = IfFinite(Degrees(*margin));
  }
}

void AddShares(const sim::HandMeasures& hand, const sim::HandTolerance& tolerance,
               StepMeasures& measures) {
  const double at_rest = tolerance.at_rest;
  measures.deviation_percent =
      IfFinite(100 * std::max({hand.off_m / tolerance.length_m, hand.off_rad / tolerance.angle_rad,
                               hand.rest_off_m / (at_rest * tolerance.length_m),
                               hand.rest_off_rad / (at_rest * tolerance.angle_rad)}));
  measures.slip_percent = IfFinite(100 * hand.slip_m / tolerance.slip_m);
}

}  // namespace

std::vector<StepMeasures> MeasureSteps(const Report& report) {
  std::vector<StepMeasures> all;
  for (const ReportStep& step : report.steps) {
    StepMeasures& measures = all.emplace_back();
    if (!step.skipped && step.check.required) {
      measures.margin_deg = Degrees(report.friction_angle - step.check.required->upper);
    }
    if (step.skipped || !step.replay) continue;
    AddReplay(*step.replay, measures);
    if (report.settings && report.settings->hand && step.replay->hand) {
      AddShares(*step.replay->hand, report.settings->hand->tolerance, measures);
    }
  }
  return all;
}

std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index,
                      std::span<const std::string> finger_names) {
  return Capitalized(render::EntryTitle(plan, index, finger_names));
}

std::string StepName(plan::EntryIndex index) {
  return index == 0 ? "the hold" : "step " + std::to_string(index);
}

std::string CauseAndFix(const std::string& why, const std::string& suggested_fix) {
  return (why.empty() ? "" : "\nWhy: " + why + ".") +
         (suggested_fix.empty() ? "" : "\nHelp: " + suggested_fix + ".");
}

std::string Capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
  return text;
}

namespace {

// Names of columns.
constexpr char kRequired[] = "Required friction";
constexpr char kMargin[] = "Friction margin";
constexpr char kDisplacement[] = "Displacement";
constexpr char kRotation[] = "Rotation";
constexpr char kSlip[] = "Slip";

/// Motions below these lengths and angles are errors of the simulation.
constexpr double kLeastMotion_m = 1e-6;
constexpr double kLeastRotation_deg = 1e-3;

std::string MotionText(double metres) {
  return metres < kLeastMotion_m ? "<\u00a01\u00a0µm" : LengthText(metres);
}

std::string RotationText(double degrees) {
  return degrees < kLeastRotation_deg ? "<\u00a00.001°" : NumberText(degrees) + "°";
}

std::string DegreesOr(const std::optional<double>& radians, const char* otherwise) {
  return radians ? FormatDegrees(Degrees(*radians)) : otherwise;
}

std::string Required(const plan::StepCheck& check) {
  if (check.skipped) return kNoStepValue;
  if (check.required) return FormatRequiredDegrees(Degrees(check.required->upper)) + "°";
  const bool decided =
      check.reason == plan::Reason::kNotForceClosure || check.reason == plan::Reason::kNotProved;
  return decided ? "none" : kNoStepValue;
}

Element TitleCell(const std::string& title, const std::string& anchor) {
  if (anchor.empty()) return Element("td", {}, title);
  return Element("td", {}, Element("a", {{"href", "#" + anchor}}, title));
}

Element StepRow(const ReportStep& step, const std::string& title, const StepMeasures& measures,
                const std::string& anchor) {
  const sim::StepReplay* replay = step.replay && !step.skipped ? &*step.replay : nullptr;
  return Element(
      "tr", {{"class", std::string(VerdictName(step.verdict()))}},
      NumberCell(std::to_string(step.check.index)),
      Element("td", {{"class", "outcome"}}, VerdictText(step)), TitleCell(title, anchor),
      NamedCell(kRequired, Required(step.check)),
      NamedCell(kMargin, measures.margin_deg ? FormatDegrees(*measures.margin_deg) : kNoStepValue),
      NamedCell(kDisplacement, replay ? MotionText(replay->displacement_m) : kNoStepValue),
      NamedCell(kRotation, replay ? RotationText(replay->rotation_deg) : kNoStepValue),
      NamedCell(kSlip, replay ? MotionText(replay->slip_m) : kNoStepValue));
}

}  // namespace

std::vector<Element> MakeStepTable(const Report& report, const plan::Plan& plan,
                                   const std::vector<StepMeasures>& measures,
                                   const std::vector<std::string>& anchors,
                                   std::span<const std::string> finger_names) {
  const std::vector<Element> head = {
      HeadCell("Step"),  HeadCell("Verdict", ""), HeadCell("Description", ""), HeadCell(kRequired),
      HeadCell(kMargin), HeadCell(kDisplacement), HeadCell(kRotation),         HeadCell(kSlip)};
  // The disturbance test of a hand replay checks limits, and its deviations are not recorded.
  const bool is_by_hand = report.settings && report.settings->hand;
  std::vector<Element> rows;
  for (const ReportStep& step : report.steps) {
    const plan::EntryIndex index = step.check.index;
    rows.push_back(
        StepRow(step, StepTitle(plan, index, finger_names), measures[index], anchors[index]));
  }
  return {
      ScrolledTable(head, rows, "cards"),
      Note("Required friction: the smallest friction angle at which every grasp of the step is " +
           StabilityText(report) +
           ". Friction margin: the plan’s friction angle minus the required one. "
           "Displacement, rotation and slip: the largest values in the replay of the step" +
           std::string(is_by_hand ? "." : " and in the disturbance test after it."))};
}

std::vector<Element> MakeFingerTable(const Report& report) {
  if (!report.grasp || report.grasp->fingers.empty()) return {};
  std::vector<Element> rows;
  for (std::size_t i = 0; i < report.grasp->fingers.size(); ++i) {
    const grasp::FingerFriction& finger = report.grasp->fingers[i];
    rows.emplace_back("tr", Attributes(), NumberCell(std::to_string(i)),
                      NumberCell(FormatRequiredDegrees(Degrees(finger.required)) + "°"),
                      NumberCell(FormatDegrees(Degrees(report.friction_angle - finger.required))),
                      NumberCell(DegreesOr(finger.without, "none")));
  }
  return {
      Element("h2", {}, "Fingers"),
      ScrolledTable(
          HeadCells({"Finger", "Required alone", "Friction margin", "Required without it"}), rows),
      Note("Required alone: the smallest friction angle of this finger at which the grasp is "
           "force closure while all others keep theirs. Required without it: the friction angle "
           "at which the grasp is force closure without this finger.")};
}

}  // namespace regrasp::report
