#include "report/trials_report.h"

#include <utility>

#include "planner/base/angle.h"
#include "planner/base/binomial.h"
#include "planner/base/limit_text.h"
#include "planner/base/number.h"

namespace regrasp::report {

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
         " trials pass (" + share + " %), and --min-pass-rate requires " + required + " %";
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
  return (options.joint_noise ? "object at first off by " : "contacts off by ") +
         FormatShort(options.position_noise) + " diameters, " + joints + "friction by " +
         TrialPercent(options.friction_error) + " %, mass by " + TrialPercent(options.mass_error) +
         " % (standard deviations); seed " + std::to_string(options.seed);
}

}  // namespace regrasp::report
