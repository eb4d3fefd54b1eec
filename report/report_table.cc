#include "report/report_table.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/base/text_table.h"
#include "planner/grasp/quality.h"
#include "report/engine_table.h"
#include "report/failure.h"
#include "report/goal_table.h"
#include "report/report.h"
#include "report/report_json.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"

namespace regrasp::report {

std::string GraspForceText(const sim::ReplaySettings& settings) {
  const double weight = settings.mass_kg * sim::kGravity;
  const std::string grasp_force = FormatShort(settings.grasp_force_N) + " N, " +
                                  FormatShort(settings.grasp_force_N / weight) + " × weight";
  switch (settings.grasp_force_source) {
    case sim::GraspForceSource::kDisturbance:
      return grasp_force + "; see --grasp-force realistic";
    case sim::GraspForceSource::kHand:
      if (settings.grasp_force_N >= sim::kStrongestGrip_N) {
        return grasp_force + ": largest grasp force of a hand";
      }
      return grasp_force + ": " + FormatShort(sim::kGripSafety) + " × what the weight requires";
    case sim::GraspForceSource::kTorques:
      return grasp_force + ": by weight, torques and stability";
    case sim::GraspForceSource::kGiven:
      return grasp_force + ": given by --grasp-force";
  }
  return grasp_force;
}

std::string FeedbackText(const sim::HandSensing& sensing) {
  if (sensing.feedback == sim::PoseFeedback::kNone) return "no object pose, joints and touch only";
  std::string text = "object pose " + FormatShort(1e3 * sensing.pose_delay_s) + " ms late at " +
                     FormatShort(sensing.pose_rate_Hz) + " Hz, noise " +
                     FormatLength(sensing.pose_noise_m) + " and " +
                     FormatDegrees(Degrees(sensing.pose_noise_rad));
  if (sensing.pose_bias_m > 0 || sensing.pose_bias_rad > 0) {
    text += ", bias " + FormatLength(sensing.pose_bias_m) + " and " +
            FormatDegrees(Degrees(sensing.pose_bias_rad));
  }
  return text;
}

namespace {

std::string Percent(double share) { return FormatShort(100 * share, 2); }

/// Return "+x" for a force, "t+x" for a torque.
std::string ShortName(const sim::Disturbance& disturbance) {
  return std::string(disturbance.turn ? "t" : "") + (disturbance.sign > 0 ? "+" : "-") +
         "xyz"[disturbance.axis];
}

}  // namespace

std::optional<WeakestDisturbance> FindWeakestDisturbance(const Report& report) {
  std::optional<WeakestDisturbance> weakest;
  for (const ReportStep& step : report.steps) {
    if (!step.replay || step.skipped) continue;
    for (const sim::ResistedWrench& resisted_wrench : step.replay->resisted_wrench) {
      if (weakest && resisted_wrench.replay >= weakest->resisted_wrench.replay) continue;
      weakest = WeakestDisturbance{step.check.index, resisted_wrench};
    }
  }
  return weakest;
}

std::string FormatResistedWrenchTable(const Report& report) {
  const auto weakest = FindWeakestDisturbance(report);
  if (!weakest) return "";
  std::vector<TextRow> rows = {{"step"}};
  for (const sim::Disturbance& disturbance : sim::DisturbanceDirections(report.dimension)) {
    rows.front().push_back(ShortName(disturbance));
  }
  for (const ReportStep& step : report.steps) {
    if (!step.replay || step.skipped || step.replay->resisted_wrench.empty()) continue;
    TextRow row = {std::to_string(step.check.index)};
    for (const sim::ResistedWrench& resisted_wrench : step.replay->resisted_wrench)
      row.push_back(Percent(resisted_wrench.replay));
    rows.push_back(row);
  }
  return "largest resisted disturbance (t: torque) in percent of the grasp force:\n" +
         FormatRows(rows) + "least: step " + std::to_string(weakest->step) + ", " +
         sim::DisturbanceName(weakest->resisted_wrench.disturbance) + ", " +
         Percent(weakest->resisted_wrench.replay) + " % in the replay, " +
         Percent(weakest->resisted_wrench.analysis) + " % by analysis\n";
}

namespace {

constexpr int kPercentDigits = 3;

std::string TrialPercent(double share) { return FormatShort(100 * share, kPercentDigits); }

}  // namespace

Json TrialsJson(const sim::TrialSummary& summary) {
  const ShareInterval interval = summary.interval();
  Json reasons = Json::object();
  for (const auto& [reason, count] : summary.reasons) {
    reasons[std::string(plan::ReasonName(reason))] = count;
  }
  Json steps = Json::array();
  for (const auto& [index, count] : summary.steps) {
    steps.push_back({{"index", int{index}}, {"failed", count}});
  }
  Json json = {{"count", summary.options.count},
               {"seed", summary.options.seed},
               {"position_noise", summary.options.position_noise},
               {"friction_error", summary.options.friction_error},
               {"mass_error", summary.options.mass_error},
               {"min_pass_rate", summary.options.min_pass_rate},
               {"passed", summary.passed},
               {"verdict", summary.enough() ? "pass" : "fail"},
               {"share", summary.share()},
               {"confidence", sim::kTrialConfidence},
               {"interval", {interval.lower, interval.upper}},
               {"reasons", reasons},
               {"steps", steps}};
  if (summary.options.joint_noise) json["joint_noise_deg"] = Degrees(*summary.options.joint_noise);
  return json;
}

std::string TrialsPassText(const sim::TrialSummary& summary) {
  return "in " + std::to_string(summary.passed) + " of " + std::to_string(summary.options.count) +
         " trials";
}

std::string TrialsRequiredText(const sim::TrialSummary& summary) {
  const auto [share, required] =
      FormatWithLimit(100 * summary.share(), 100 * summary.options.min_pass_rate, kPercentDigits);
  return std::to_string(summary.passed) + " of " + std::to_string(summary.options.count) +
         " trials pass (" + share + " %), --trials min-pass-rate requires " + required + " %";
}

std::string TrialsShareText(const sim::TrialSummary& summary) {
  const ShareInterval interval = summary.interval();
  return std::to_string(summary.passed) + " of " + std::to_string(summary.options.count) +
         " pass: " + TrialPercent(summary.share()) + " %, with " +
         TrialPercent(sim::kTrialConfidence) + " % confidence between " +
         TrialPercent(interval.lower) + " and " + TrialPercent(interval.upper) + " %; required " +
         TrialPercent(summary.options.min_pass_rate) + " %";
}

std::string TrialsFailureText(const sim::TrialSummary& summary) {
  const int failed = summary.options.count - summary.passed;
  if (failed == 0) return "";
  std::string text = std::to_string(failed) + " of " + std::to_string(summary.options.count) +
                     " trials with noise fail";
  const char* between = ": ";
  for (const auto& [reason, count] : summary.reasons) {
    text += std::exchange(between, ", ") + std::to_string(count) + " " +
            std::string(plan::ReasonName(reason));
  }
  const char* before = "; first in ";
  for (const auto& [index, count] : summary.steps) {
    text += before + ("step " + std::to_string(index)) + ": " + std::to_string(count);
    before = ", ";
  }
  return text;
}

std::string TrialsNoiseText(const sim::TrialSummary& summary) {
  const sim::TrialOptions& options = summary.options;
  const std::string joints =
      options.joint_noise ? "joints by " + FormatShort(Degrees(*options.joint_noise)) + "°, " : "";
  return (options.joint_noise ? "initial object pose by " : "contacts off by ") +
         FormatShort(options.position_noise) + " diameters, " + joints + "friction by " +
         TrialPercent(options.friction_error) + " %, mass by " + TrialPercent(options.mass_error) +
         " % (standard deviations); seed " + std::to_string(options.seed);
}

namespace {

/// Significant digits of lengths.
constexpr int kLengthDigits = 2;
constexpr double kMillimetres = 1e3;

/// Return a length in millimetres. Motions of less than a micrometre are errors of the simulation.
std::string MillimetresText(double metres) {
  constexpr double kLeast_m = 1e-6;
  return metres < kLeast_m ? "<0.001" : FormatPlain(kMillimetres * metres, kLengthDigits);
}

constexpr char kNothing[] = "-";

std::string RequiredAngle(const ReportStep& step) {
  if (step.check.skipped) return kNothing;
  if (!step.check.required) return "none";
  return FormatRequiredDegrees(Degrees(step.check.required->upper));
}

/// Optional columns of a table.
struct Columns {
  bool regions = false;
  bool fixed = false;  ///< verdict at fixed grasp force, next to the adapted one that decides
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
    return step.replay ? MillimetresText((*step.replay).*member) : kNothing;
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
  const std::string weakest = plan::WeakestStepText(report.checks(), report.friction_angle);
  return weakest.empty() ? "" : "weakest: " + weakest + "\n";
}

/// Return the friction that a finger requires, or that the other fingers require without it.
std::string NeedText(const grasp::FingerFriction& finger, double friction_angle,
                     const std::string& what) {
  const auto [needed, available] = FormatRequiredDegrees(
      Degrees(finger.needed ? finger.required : *finger.without), Degrees(friction_angle));
  return (finger.needed ? ", which alone requires " : ", without which the others require ") +
         what + needed + " of " + available + " degrees\n";
}

/// Format quality and weakest finger of a single grasp.
std::string FormatGraspLines(const Report& report) {
  const int weakest = grasp::WeakestFinger(report.grasp->fingers);
  if (weakest < 0) return "";
  return "quality: " + grasp::QualityText(report.grasp->quality) + "\nweakest: finger " +
         std::to_string(weakest) +
         NeedText(report.grasp->fingers[weakest], report.friction_angle, "a friction angle of ");
}

/// Format the disagreements of steps that pass. A failure includes its own cause.
std::string FormatCauses(const Report& report) {
  std::string text;
  for (const ReportStep& step : report.steps) {
    if (!step.disagreement || step.disagreement->between != sim::Between::kFixedFails) continue;
    text += "step " + std::to_string(step.check.index) + ": a fixed grasp force fails, " +
            sim::LikelyCauseText(*step.disagreement) + "\n";
  }
  return text;
}

/// Format every step on which two engines differ, or that they agree.
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
  return FormatEngineTable(report) + text + "engines: MuJoCo and ODE agree on " +
         std::to_string(agreed) + (agreed == 1 ? " step\n" : " steps\n");
}

/// Format the weakest finger of the whole plan.
std::string FormatWeakestFinger(const Report& report) {
  const plan::EntryIndex index = report.weakest_finger_step();
  if (!index.valid() || report.grasp) return "";
  const ReportStep& step = report.steps[index];
  const sim::NeedOfFinger& need = *step.weakest_finger;
  return "weakest finger: " + std::to_string(need.finger) + " in step " + std::to_string(index) +
         NeedText(need.friction, report.friction_angle, "");
}

/// Format the weakest point of a plan whose steps pass. A plan that fails prints its failure
/// instead.
std::string FormatWeakestOfPlan(const Report& report) {
  return report.steps_passed() ? FormatWeakest(report) + FormatWeakestFinger(report) : "";
}

std::string FormatUndecided(const Report& report) {
  long undecided = 0;
  for (const ReportStep& step : report.steps) undecided += step.check.undecided;
  if (undecided == 0) return "";
  return "undecided: " + std::to_string(undecided) +
         " pieces of sliding steps, a millionth of the path each\n";
}

/// Format the object and the grasp force.
std::string FormatBody(const Report& report) {
  return (report.measures.empty() ? "" : "object: " + report.measures + "\n") +
         (report.farthest_from_points
              ? "contacts: at given points, at most " +
                    FormatLength(*report.farthest_from_points * report.scale) + " off\n"
              : "") +
         (report.settings ? "grasp force: " + GraspForceText(*report.settings) + "\n" : "") +
         (report.settings && report.settings->hand
              ? "feedback: " + FeedbackText(report.settings->hand->sensing) + "\n" +
                    "limits: " + LimitsText(report.settings->hand->limits) + "\n"
              : "");
}

std::string FormatVerdict(const Report& report) {
  const auto failure = DescribeFailure(report);
  const std::string trials = report.trials ? " " + TrialsPassText(*report.trials) : "";
  const std::string conditions =
      report.conditions ? " " + ConditionsPassText(*report.conditions) : "";
  const std::string between = report.trials && report.conditions ? "," : "";
  return "verdict: " +
         (failure ? "fail, " + failure->headline() : "pass" + trials + between + conditions) + "\n";
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
  std::vector<TextRow> rows = {{"step", "kind", "required_deg", "displacement_mm", "slip_mm"}};
  if (columns.regions) rows.front().push_back("region");
  if (columns.fixed) rows.front().push_back("fixed_force");
  rows.front().push_back("verdict");
  for (const ReportStep& step : report.steps) rows.push_back(MakeRow(step, columns));
  return FormatFailure(report) + FormatRows(rows) + FormatGoalTable(report) + FormatBody(report) +
         FormatCauses(report) + FormatEngines(report) + FormatUndecided(report) +
         (report.grasp ? FormatGraspLines(report) : FormatWeakestOfPlan(report)) +
         FormatResistedWrenchTable(report) + FormatTrials(report) + FormatConditionTable(report) +
         FormatVerdict(report);
}

namespace {

constexpr int kShareDigits = 3;
constexpr int kEndDigits = 2;

std::string PercentText(double share) { return FormatShort(100 * share, kShareDigits) + " %"; }

std::string OfAllText(int count, const sim::ConditionSummary& summary) {
  return std::to_string(count) + " of " + std::to_string(summary.applicable());
}

const char* VerdictOf(const sim::ConditionResult& result) {
  if (!result.applies) return "skipped";
  return result.passed() ? "pass" : "fail";
}

Json ResultJson(const sim::ConditionResult& result) {
  Json json = {{"name", result.condition.name},
               {"changes", ParseJson(result.condition.changes, result.condition.name)},
               {"verdict", VerdictOf(result)},
               {"step", IndexOrNull(result.failed)},
               {"reason", TextOrNull(plan::ReasonName(result.reason))},
               {"detail", TextOrNull(result.detail)}};
  if (!result.applies) return json;
  json["reaches_end"] = result.reaches_end;
  json["ends_within"] = result.ends_within;
  json["displacement_m"] = result.end_m;
  json["rotation_deg"] = Degrees(result.end_rad);
  json["margin"] = result.margin;
  return json;
}

TextRow MakeConditionRow(const sim::ConditionResult& result) {
  constexpr char kNone[] = "-";
  if (!result.applies) {
    return {result.condition.name, kNone, kNone, kNone, kNone, kNone, "not applicable"};
  }
  return {result.condition.name,
          result.failed.valid() ? std::to_string(result.failed) : kNone,
          FormatShort(kMillimetres * result.end_m, kEndDigits),
          FormatShort(Degrees(result.end_rad), kEndDigits),
          result.ends_within ? "yes" : "no",
          FormatShort(result.margin, kEndDigits),
          ConditionVerdictText(result)};
}

}  // namespace

Json ConditionsJson(const sim::ConditionSummary& summary) {
  Json results = Json::array();
  for (const sim::ConditionResult& result : summary.results) results.push_back(ResultJson(result));
  return {{"verdict", summary.enough() ? "pass" : "fail"},
          {"required", OrNull(summary.required)},
          {"applicable", summary.applicable()},
          {"passed", summary.passed()},
          {"ended_within", summary.ended_within()},
          {"share", summary.share()},
          {"results", results}};
}

std::string ConditionVerdictText(const sim::ConditionResult& result) {
  return result.applies ? ReasonText(result.reason) : "not applicable";
}

std::string ConditionsPassText(const sim::ConditionSummary& summary) {
  return "under " + OfAllText(summary.passed(), summary) + " conditions";
}

std::string ConditionsShareText(const sim::ConditionSummary& summary) {
  return OfAllText(summary.passed(), summary) + " pass, " +
         OfAllText(summary.ended_within(), summary) + " end within the tolerance" +
         (summary.required ? "; required " + PercentText(*summary.required) : "");
}

std::string ConditionsFailureText(const sim::ConditionSummary& summary) {
  if (summary.applicable() == 0) return "no condition applies to the hand and the engine";
  const int failed = summary.applicable() - summary.passed();
  if (failed == 0) return "";
  std::string text = OfAllText(failed, summary) + " conditions fail";
  const char* between = ": ";
  for (const sim::ConditionResult& result : summary.results) {
    if (!result.applies || result.passed()) continue;
    text +=
        between + result.condition.name + " (" + std::string(plan::ReasonName(result.reason)) + ")";
    between = ", ";
  }
  return text;
}

std::string ConditionsRequiredText(const sim::ConditionSummary& summary) {
  const auto [share, required] =
      FormatWithLimit(100 * summary.share(), 100 * summary.required.value_or(0), kShareDigits);
  return OfAllText(summary.passed(), summary) + " conditions pass (" + share +
         " %), --conditions requires " + required + " %";
}

std::string FormatConditionTable(const Report& report) {
  if (!report.conditions) return "";
  std::vector<TextRow> rows = {
      {"condition", "step", "end_mm", "end_deg", "ends_within", "margin", "verdict"}};
  for (const sim::ConditionResult& result : report.conditions->results) {
    rows.push_back(MakeConditionRow(result));
  }
  return FormatRows(rows) + "conditions: " + ConditionsShareText(*report.conditions) + "\n";
}

}  // namespace regrasp::report
