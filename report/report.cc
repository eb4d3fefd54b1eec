#include "report/report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "planner/base/number.h"

namespace regrasp::report {

namespace {

/// Significant digits of a torque.
constexpr int kTorqueDigits = 3;
/// Geometry of a fingertip that is less deep in the object is not mentioned, metres.
constexpr double kMentionedDepth = 1e-3;

bool IsUnlimited(const sim::DriveLimits& limit) { return !std::isfinite(limit.torque_Nm); }

std::string TorqueText(double torque) { return FormatShort(torque, kTorqueDigits); }

/// "1 joint range", "2 joint ranges".
std::string CountedText(std::ptrdiff_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// "3 of 16 actuators".
std::string UnlimitedText(const std::vector<sim::DriveLimits>& limits) {
  return std::to_string(std::ranges::count_if(limits, IsUnlimited)) + " of " +
         CountedText(std::ssize(limits), "actuator");
}

/// Add the assumptions of a replay by a hand: actuators without a force limit, and fingertips whose
/// geometry is in the object because a sphere replaces it.
void AddHandWarnings(const Report& report, std::vector<std::string>& warnings) {
  if (!report.settings || !report.settings->hand) return;
  double torque = 0;
  double covered = 0;
  for (const ReportStep& step : report.steps) {
    if (!step.replay || !step.replay->hand) continue;
    torque = std::max(torque, step.replay->hand->torque_Nm);
    covered = std::max(covered, step.replay->hand->covered_depth_m);
  }
  const std::vector<sim::DriveLimits>& limits = report.settings->hand->limits;
  if (std::ranges::any_of(limits, IsUnlimited)) {
    warnings.push_back("force limits not found in the hand model for " + UnlimitedText(limits) +
                       ", treated as unlimited; largest torque " + TorqueText(torque) + " N·m");
  }
  if (const auto& soft = report.settings->hand->soft_stiffness) {
    warnings.push_back("the model's servos are softer than those of the replay, from " +
                       FormatShort(*soft) + " N·m/rad: the hand requires a joint controller with " +
                       FormatShort(report.settings->hand->least_stiffness) + " N·m/rad");
  }
  if (covered > kMentionedDepth) {
    warnings.push_back("the collision geometry of a fingertip is up to " + FormatLength(covered) +
                       " inside the object when its sphere touches; help: validate with "
                       "--replay tip=geometry");
  }
}

/// State in how many static grasps only gravity keeps the object on the fingers.
void AddSupportWarning(const Report& report, std::vector<std::string>& warnings) {
  const auto supported = std::ranges::count_if(
      report.steps, [](const ReportStep& step) { return step.check.ends_supported; });
  std::optional<double> resistance;
  for (const ReportStep& step : report.steps) {
    if (!step.check.resistance) continue;
    resistance = std::min(*step.check.resistance, resistance.value_or(*step.check.resistance));
  }
  if (!resistance) return;
  warnings.push_back("gravity-supported in " + std::to_string(supported) + " of " +
                     CountedText(std::ssize(report.steps), "static grasp") +
                     ": not force closure, resists disturbances of " + FormatShort(*resistance, 2) +
                     " weights of the object");
}

}  // namespace

std::string_view VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kPass:
      return "pass";
    case Verdict::kFail:
      return "fail";
    case Verdict::kSkipped:
      return "skipped";
  }
  return "";
}

std::string ReasonText(plan::Reason reason) {
  return reason == plan::Reason::kNone ? "pass" : "fail: " + std::string(plan::ReasonName(reason));
}

std::string VerdictText(const ReportStep& step) {
  return step.skipped ? "skipped" : ReasonText(step.reason());
}

std::string LimitsText(const std::vector<sim::DriveLimits>& limits) {
  if (limits.empty()) return "none";
  double least = std::numeric_limits<double>::infinity();
  double most = 0;
  for (const sim::DriveLimits& limit : limits) {
    if (IsUnlimited(limit)) continue;
    least = std::min(least, limit.torque_Nm);
    most = std::max(most, limit.torque_Nm);
  }
  std::string text;
  if (most > 0) {
    text =
        "torque " + (least < most ? TorqueText(least) + " to " : "") + TorqueText(most) + " N·m, ";
  }
  if (std::ranges::any_of(limits, IsUnlimited)) {
    text += "force limit unknown for " + UnlimitedText(limits) + ", ";
  }
  const auto controls = std::ranges::count_if(
      limits, [](const sim::DriveLimits& limit) { return limit.control.has_value(); });
  return text + CountedText(controls, "control range") + ", " +
         CountedText(std::ssize(limits), "joint range");
}

std::string StabilityText(const Report& report) {
  const bool is_supported = std::ranges::any_of(
      report.steps, [](const ReportStep& step) { return step.check.is_supported; });
  return is_supported ? "force closure or supported by gravity" : "force closure";
}

std::vector<std::string> Warnings(const Report& report) {
  std::vector<std::string> warnings;
  for (const ReportStep& step : report.steps) {
    const std::string name = "step " + std::to_string(step.check.index);
    if (step.region && !step.region->holds) {
      const auto [width, claimed] =
          FormatWithLimit(step.region->half_width, *step.region->claimed, 4);
      warnings.push_back(name + ": contact region: expected " + claimed +
                         " as in the plan, found " + width);
    }
    if (step.certificate && !step.certificate->proves()) {
      warnings.push_back(name + ": invalid certificate in the plan: " + step.certificate->why);
    }
  }
  AddSupportWarning(report, warnings);
  AddHandWarnings(report, warnings);
  return warnings;
}

}  // namespace regrasp::report
