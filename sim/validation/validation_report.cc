#include "sim/validation/validation_report.h"

#include <algorithm>

namespace regrasp::validation {

plan::Reason ReportStep::reason() const {
  if (skipped) return plan::Reason::kNone;
  if (check.reason != plan::Reason::kNone) return check.reason;
  return replay ? replay->reason : plan::Reason::kNone;
}

const std::string& ReportStep::detail() const {
  return replay && check.reason == plan::Reason::kNone ? replay->detail : check.detail;
}

const plan::Fault& ReportStep::fault() const {
  return replay && check.reason == plan::Reason::kNone ? replay->fault : check.fault;
}

Verdict ReportStep::verdict() const {
  if (skipped) return Verdict::kSkipped;
  return reason() == plan::Reason::kNone ? Verdict::kPass : Verdict::kFail;
}

bool Report::passed() const {
  return steps_passed() && (!trials || trials->enough()) && (!conditions || conditions->enough());
}

bool Report::steps_passed() const {
  return std::all_of(steps.begin(), steps.end(),
                     [](const ReportStep& step) { return step.verdict() == Verdict::kPass; });
}

plan::EntryIndex Report::weakest_step() const { return plan::WeakestStep(checks()); }

std::vector<plan::StepCheck> Report::checks() const {
  std::vector<plan::StepCheck> checks;
  for (const ReportStep& step : steps) {
    checks.push_back(step.check);
    checks.back().skipped = step.skipped;
  }
  return checks;
}

plan::EntryIndex Report::weakest_finger_step() const {
  std::vector<grasp::FingerFriction> weakest;
  std::vector<plan::EntryIndex> index;
  for (const ReportStep& step : steps) {
    if (step.skipped || !step.weakest_finger) continue;
    weakest.push_back(step.weakest_finger->friction);
    index.push_back(step.check.index);
  }
  const int found = grasp::WeakestFinger(weakest);
  return found < 0 ? plan::EntryIndex() : index[found];
}

}  // namespace regrasp::validation
