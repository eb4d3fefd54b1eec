#include "report/page/step_table.h"

#include <optional>

#include "planner/base/angle.h"
#include "planner/base/limit_text.h"
#include "planner/base/quantity_text.h"
#include "report/page/quantity.h"
#include "report/page/step_text.h"
#include "report/page/table.h"

namespace regrasp::report {

namespace {

constexpr char kNoStepValue[] = "–";

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

Element MinorCell(std::string_view text) {
  return Element("td", {{"class", "number minor"}}, text);
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
      NumberCell(std::to_string(step.check.index)), TitleCell(title, anchor),
      MinorCell(Required(step.check)),
      NumberCell(measures.margin_deg ? FormatDegrees(*measures.margin_deg) : kNoStepValue),
      NumberCell(replay ? LengthText(replay->displacement_m) : kNoStepValue),
      MinorCell(replay ? NumberText(replay->rotation_deg) + "°" : kNoStepValue),
      NumberCell(replay ? LengthText(replay->slip_m) : kNoStepValue),
      Element("td", {}, VerdictText(step)));
}

}  // namespace

std::vector<Element> MakeStepTable(const Report& report, const plan::Plan& plan,
                                   const std::vector<StepMeasures>& measures,
                                   const std::vector<std::string>& anchors) {
  const std::vector<Element> head = {
      HeadCell("Step"),   HeadCell("What happens", ""), HeadCell("Needs", "number minor"),
      HeadCell("Margin"), HeadCell("Displacement"),     HeadCell("Rotation", "number minor"),
      HeadCell("Slip"),   HeadCell("Verdict", "")};
  std::vector<Element> rows;
  for (const ReportStep& step : report.steps) {
    const plan::EntryIndex index = step.check.index;
    rows.push_back(StepRow(step, StepTitle(plan, index), measures[index], anchors[index]));
  }
  return {ScrolledTable(head, rows),
          Note("Needs: the smallest friction half-angle at which every grasp of the step is "
               "force closure. Margin: what is left of the plan’s friction. Displacement, "
               "rotation and slip: the largest in the replay of the step and the shakes after "
               "it.")};
}

std::vector<Element> MakeFingerTable(const Report& report) {
  if (!report.grasp || report.grasp->fingers.empty()) return {};
  std::vector<Element> rows;
  for (std::size_t i = 0; i < report.grasp->fingers.size(); ++i) {
    const grasp::FingerFriction& finger = report.grasp->fingers[i];
    rows.emplace_back("tr", Attributes(), NumberCell(std::to_string(i)),
                      NumberCell(FormatRequiredDegrees(Degrees(finger.required)) + "°"),
                      NumberCell(FormatDegrees(Degrees(report.half_angle - finger.required))),
                      NumberCell(DegreesOr(finger.without, "none")));
  }
  return {
      Element("h2", {}, "Fingers"),
      ScrolledTable(HeadCells({"Finger", "Needs alone", "Margin", "Others need without it"}), rows),
      Note("Needs alone: how far the friction half-angle of this finger may fall while all "
           "others keep theirs; 0 where it is not needed. Others need without it: the "
           "friction half-angle at which the grasp is force closure without this finger.")};
}

}  // namespace regrasp::report
