#include "report/report.h"

#include "planner/base/limit_text.h"
#include "report/hand_limits.h"

namespace regrasp::report {

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

std::vector<std::string> Warnings(const Report& report) {
  std::vector<std::string> warnings;
  for (const ReportStep& step : report.steps) {
    const std::string name = "step " + std::to_string(step.check.index);
    if (step.region && !step.region->holds) {
      const auto [width, claimed] =
          FormatWithLimit(step.region->half_width, *step.region->claimed, 4);
      warnings.push_back(name + ": the plan claims a contact region of " + claimed +
                         ", but it is " + width);
    }
    if (step.certificate && !step.certificate->proves()) {
      warnings.push_back(name + ": the plan's certificate is not valid: " + step.certificate->why);
    }
  }
  AddHandWarnings(report, warnings);
  return warnings;
}

}  // namespace regrasp::report
