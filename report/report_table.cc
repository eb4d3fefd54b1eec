#include <algorithm>
#include <string>
#include <vector>

#include "planner/base/angle.h"
#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/base/quantity_text.h"
#include "planner/base/text_table.h"
#include "planner/grasp/quality.h"
#include "report/failure.h"
#include "report/hand_limits.h"
#include "report/report.h"
#include "report/squeeze_text.h"
#include "report/stress_table.h"
#include "report/trials_report.h"
#include "sim/measure/weakest_finger.h"

namespace regrasp::report {

namespace {

/// Lengths to two significant digits.
constexpr int kLengthDigits = 2;

constexpr char kNothing[] = "-";

std::string RequiredAngle(const ReportStep& step) {
  if (step.check.skipped) return kNothing;
  if (!step.check.required) return "none";
  return FormatRequiredDegrees(Degrees(step.check.required->upper));
}

/// Which columns a table has beside those that it always has.
struct Columns {
  bool regions = false;
  bool fixed = false;  ///< the verdict at fixed squeeze, beside the adapted one that decides
};

Columns ColumnsOf(const Report& report) {
  const auto has = [&](auto property) { return std::ranges::any_of(report.steps, property); };
  return {has([](const ReportStep& step) { return step.region.has_value(); }),
          has([](const ReportStep& step) {
            return step.replay && step.replay->adapted && step.replay->fixed;
          })};
}

std::string FixedVerdict(const ReportStep& step) {
  if (!step.replay || !step.replay->fixed || step.skipped) return kNothing;
  return ReasonText(step.replay->fixed->reason);
}

TextRow MakeRow(const ReportStep& step, const Columns& columns) {
  const auto length = [&](double sim::StepReplay::*member) -> std::string {
    return step.replay ? FormatShort((*step.replay).*member, kLengthDigits) : kNothing;
  };
  TextRow row = {std::to_string(step.check.index), step.check.kind, RequiredAngle(step),
                 length(&sim::StepReplay::displacement_m), length(&sim::StepReplay::slip_m)};
  if (columns.regions) {
    row.push_back(step.region ? FormatShort(step.region->half_width, kLengthDigits) : kNothing);
  }
  if (columns.fixed) row.push_back(FixedVerdict(step));
  row.push_back(VerdictText(step));
  return row;
}

std::string FormatWeakest(const Report& report) {
  const std::string weakest = plan::WeakestStepText(report.checks(), report.half_angle);
  return weakest.empty() ? "" : "weakest: " + weakest + "\n";
}

/// What a finger needs, or the others without it.
std::string NeedText(const grasp::FingerFriction& finger, double half_angle,
                     const std::string& what) {
  const auto [needed, available] = FormatRequiredDegrees(
      Degrees(finger.needed ? finger.required : *finger.without), Degrees(half_angle));
  return (finger.needed ? ", which alone needs " : ", without which the others need ") + what +
         needed + " of " + available + " degrees\n";
}

/// Quality and weakest finger of a single grasp.
std::string FormatGraspLines(const Report& report) {
  const int weakest = grasp::WeakestFinger(report.grasp->fingers);
  if (weakest < 0) return "";
  return "quality: " + grasp::QualityText(report.grasp->quality) + "\nweakest: finger " +
         std::to_string(weakest) +
         NeedText(report.grasp->fingers[weakest], report.half_angle, "a friction half-angle of ");
}

/// Of steps that pass: why one fails is told with its failure.
std::string FormatCauses(const Report& report) {
  std::string text;
  for (const ReportStep& step : report.steps) {
    if (!step.disagreement || step.disagreement->between != sim::Between::kFixedFails) continue;
    text += "step " + std::to_string(step.check.index) + ": a fixed squeeze fails, " +
            sim::LikelyCauseText(*step.disagreement) + "\n";
  }
  return text;
}

/// Every step on which two engines differ, or that they agree.
std::string FormatEngines(const Report& report) {
  if (!report.settings || report.settings->engine != sim::EngineChoice::kBoth) return "";
  std::string text;
  int agreed = 0;
  for (const ReportStep& step : report.steps) {
    if (step.engines) {
      const bool fails = step.engines->between == sim::Between::kOdeFails;
      text += "step " + std::to_string(step.check.index) + ": " +
              (fails ? "MuJoCo passes, ODE fails (" : "ODE passes, MuJoCo fails (") +
              (fails ? step.replay->ode->detail : step.replay->detail) + "); " +
              sim::LikelyCauseText(*step.engines) + "\n";
    } else if (step.replay && step.replay->ode && !step.skipped) {
      ++agreed;
    }
  }
  return text + "engines: MuJoCo and ODE agree on " + std::to_string(agreed) +
         (agreed == 1 ? " step\n" : " steps\n");
}

/// The weakest finger of the whole plan.
std::string FormatWeakestFinger(const Report& report) {
  const plan::EntryIndex index = report.weakest_finger_step();
  if (!index.valid() || report.grasp) return "";
  const ReportStep& step = report.steps[index];
  const sim::NeedOfFinger& need = *step.weakest_finger;
  return "weakest finger: " + std::to_string(need.finger) + " in step " + std::to_string(index) +
         NeedText(need.friction, report.half_angle, "");
}

/// What is weakest in a plan whose steps pass. One that fails has something weaker, which is told
/// first.
std::string FormatWeakestOfPlan(const Report& report) {
  return report.steps_passed() ? FormatWeakest(report) + FormatWeakestFinger(report) : "";
}

std::string FormatUndecided(const Report& report) {
  long undecided = 0;
  for (const ReportStep& step : report.steps) undecided += step.check.undecided;
  if (undecided == 0) return "";
  return "undecided: " + std::to_string(undecided) +
         " pieces of aligns, a millionth of the path each\n";
}

/// What was held, and how hard.
std::string FormatBody(const Report& report) {
  return (report.measures.empty() ? "" : "object: " + report.measures + "\n") +
         (report.farthest_from_points
              ? "contacts: at given points, at most " +
                    FormatLength(*report.farthest_from_points * report.scale) + " off\n"
              : "") +
         (report.settings ? "squeeze: " + SqueezeText(*report.settings) + "\n" : "") +
         (report.settings && report.settings->hand
              ? "limits: " + LimitsText(report.settings->hand->limits) + "\n"
              : "");
}

std::string FormatVerdict(const Report& report) {
  const auto failure = DescribeFailure(report);
  const std::string trials = report.trials ? " " + TrialsPassText(*report.trials) : "";
  return "verdict: " + (failure ? "fail, " + failure->headline() : "pass" + trials) + "\n";
}

std::string FormatTrials(const Report& report) {
  if (!report.trials) return "";
  const std::string failures = TrialsFailureText(*report.trials);
  return "trials: " + TrialsShareText(*report.trials) + "\n" +
         (failures.empty() ? "" : "trials that fail: " + failures + "\n") +
         "noise: " + TrialsNoiseText(*report.trials) + "\n";
}

}  // namespace

std::string FormatReportTable(const Report& report) {
  const Columns columns = ColumnsOf(report);
  std::vector<TextRow> rows = {{"step", "kind", "required_deg", "displacement_m", "slip_m"}};
  if (columns.regions) rows.front().push_back("region");
  if (columns.fixed) rows.front().push_back("fixed_squeeze");
  rows.front().push_back("verdict");
  for (const ReportStep& step : report.steps) rows.push_back(MakeRow(step, columns));
  return FormatFailure(report) + FormatRows(rows) + FormatBody(report) + FormatCauses(report) +
         FormatEngines(report) + FormatUndecided(report) +
         (report.grasp ? FormatGraspLines(report) : FormatWeakestOfPlan(report)) +
         FormatStressTable(report) + FormatTrials(report) + FormatVerdict(report);
}

}  // namespace regrasp::report
