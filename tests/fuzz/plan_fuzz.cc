// Fuzz target: any bytes as a plan file. The result must be a plan that is written as it was read
// and that the analytic check can process on a small object, or a one-line error.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hostile_input.h"
#include "planner/certificate/align_certificate.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "small_objects.h"

namespace {

using namespace regrasp;

/// Check the certificate of a step, as in validate.
/// If a sliding step passes the check, exact arithmetic must terminate, and must not prove anything
/// that the check has refuted.
void CheckCertificate(const plan::PlanCheck& check, std::size_t index) {
  const auto* align = std::get_if<plan::Align>(&check.projected.steps[index]);
  const plan::StepCheck& step = check.steps[index + 1];
  if (align == nullptr || !align->certificate || step.skipped) return;
  if (step.reason != plan::Reason::kNone && step.reason != plan::Reason::kNotForceClosure) return;
  const double mu = std::tan(check.projected.friction_angle);
  const motion::ProofVerdict verdict = certificate::CheckAlignCertificate(
      *align, check.projected.dimension, mu, *align->certificate);
  if (verdict.proves() && !step.force_closure) {
    ReportFinding("a certificate holds where the check refutes force closure");
  }
}

void ReadAndCheck(std::string_view text) {
  const plan::Plan plan = plan::ParsePlan(text, kHostileName);
  const std::string written = plan::FormatPlan(plan);
  if (plan::FormatPlan(plan::ParsePlan(written, kHostileName)) != written) {
    ReportFinding("a plan that was written reads back as another");
  }
  const object::Object& object =
      plan.dimension == 2 ? static_cast<const object::Object&>(SmallPolygon()) : SmallSolid();
  const plan::PlanCheck check = plan::CheckPlan(object, plan);
  if (check.steps.size() != plan.steps.size() + 1) ReportFinding("a step was not checked");
  for (const plan::StepCheck& step : check.steps) {
    if (step.force_closure && !step.required) ReportFinding("force closure at no angle");
  }
  for (std::size_t k = 0; k < plan.steps.size(); ++k) CheckCertificate(check, k);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ReadHostileInput([&] { ReadAndCheck(text); });
  return 0;
}
