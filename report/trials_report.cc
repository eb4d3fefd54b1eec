#include "report/trials_report.h"

#include "planner/base/angle.h"
#include "planner/base/binomial.h"
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
               {"passed", summary.passed},
               {"share", summary.share()},
               {"confidence", sim::kTrialConfidence},
               {"interval", {interval.lower, interval.upper}},
               {"reasons", reasons},
               {"steps", steps}};
  if (summary.options.joint_noise) json["joint_noise_deg"] = Degrees(*summary.options.joint_noise);
  return json;
}

std::string TrialsShareText(const sim::TrialSummary& summary) {
  const ShareInterval interval = summary.interval();
  return std::to_string(summary.passed) + " of " + std::to_string(summary.options.count) +
         " pass: " + TrialPercent(summary.share()) + " %, with " +
         TrialPercent(sim::kTrialConfidence) + " % confidence between " +
         TrialPercent(interval.lower) + " and " + TrialPercent(interval.upper) + " %";
}

std::string TrialsFailureText(const sim::TrialSummary& summary) {
  std::string text;
  for (const auto& [reason, count] : summary.reasons) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " +
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
