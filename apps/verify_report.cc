#include "apps/verify_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/plan_object.h"
#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/certificate/plan_proof.h"

namespace regrasp::apps {

namespace {

using Kind = motion::ProofVerdict::Kind;

/// Largest difference of friction angles that count as equal, radians.
/// Conversion to degrees and back causes it.
constexpr double kSameFriction = 1e-12;

void ExpectDigest(const plan::JsonReader& json, const std::string& sha256, const char* what) {
  const plan::JsonReader digest = json.Member("sha256");
  if (digest.String() == sha256) return;
  const std::string file = json.Has("file") ? json.Member("file").String() : "";
  digest.Fail(std::string("the report is for another ") + what + ", expected " +
              DescribeFile(file, digest.String()) + ", found SHA-256 " + sha256.substr(0, 12) +
              "…");
}

/// Read the proofs of the first steps. Steps after a failed step have none.
std::vector<certificate::EntryProof> ReadProofs(const plan::JsonReader& steps, int dimension) {
  std::vector<certificate::EntryProof> proofs;
  for (const plan::JsonReader& step : steps.Elements()) {
    if (!step.Has("proof")) break;
    proofs.push_back(certificate::ReadEntryProof(step.Member("proof"), dimension));
  }
  if (proofs.empty())
    steps.Fail("proofs not found; help: write the report with validate --certificates");
  return proofs;
}

std::string DescribeProof(const motion::ProofVerdict& verdict) {
  if (verdict.kind == Kind::kForceClosure) return "proved";
  if (verdict.kind == Kind::kNotForceClosure) return "refuted";
  return "not proved: " + verdict.why;
}

/// Return the failure of a step, except for force closure; empty if there is none.
std::string FaultOf(const plan::StepCheck& check) {
  if (check.skipped) return "not checked: an earlier step fails";
  if (check.reason == plan::Reason::kNone) return "";
  return "fails: " + std::string(plan::ReasonName(check.reason)) + ": " + check.detail;
}

std::string DescribeProofs(const certificate::EntryVerdict& entry) {
  std::string text = DescribeProof(entry.rest);
  for (std::size_t k = 0; k < entry.motions.size(); ++k) {
    text += (k == 0 ? "; segments " : ", ") + DescribeProof(entry.motions[k]);
  }
  return text;
}

/// Refuse a report with another friction angle: its proofs do not apply.
void ExpectFriction(const plan::JsonReader& json, double friction_angle) {
  const double degrees = json.Number();
  if (std::abs(Radians(degrees) - friction_angle) <= kSameFriction) return;
  json.Fail("expected " + FormatShort(Degrees(friction_angle)) +
            "° as of the plan or --friction-angle, found " + FormatShort(degrees) +
            "°; help: pass the --friction-angle of the report");
}

/// Refuse a report with another torsional friction length.
void ExpectTorsion(const plan::JsonReader& settings, double torsion) {
  const double found = settings.Has("torsion") ? settings.Member("torsion").Number() : 0;
  if (found == torsion) return;
  settings.Fail("torsion: expected " + FormatShort(torsion) +
                " as of the plan or --torsion, found " + FormatShort(found) +
                "; help: pass the --torsion of the report");
}

std::string Summary(const std::vector<plan::StepCheck>& checks, std::size_t proved,
                    double friction_angle) {
  const std::string entries = std::to_string(checks.size());
  std::string text = std::to_string(proved) + " of " + entries +
                     " steps proved force closure in exact arithmetic, friction angle " +
                     FormatShort(Degrees(friction_angle)) + "°\n";
  const auto fault = std::ranges::find_if(
      checks, [](const plan::StepCheck& check) { return check.reason != plan::Reason::kNone; });
  if (fault != checks.end()) {
    return text + "not proved: the plan fails the analytic check at step " +
           std::to_string(fault->index) + "\n";
  }
  if (proved < checks.size()) return text + "not proved: a step has no valid proof\n";
  return text +
         "proved: contacts on the surface, fingers free and in contact as required, steps without "
         "jumps, sliding steps on their faces, the goal, and force closure at every instant\n";
}

}  // namespace

ReportVerification VerifyReport(std::string_view text, const std::string& name,
                                const ReportSubject& subject) {
  const plan::Plan& plan = subject.plan;
  const Json json = ParseJson(text, name);
  const plan::JsonReader root(json, name);
  root.ExpectFormat("regrasp-report");
  ExpectDigest(root.Member("object"), subject.object_sha256, "object");
  ExpectDigest(root.Member("plan"), subject.plan_sha256, "plan");
  ExpectFriction(root.Member("settings").Member("friction_half_angle_deg"), plan.friction_angle);
  ExpectTorsion(root.Member("settings"), plan.torsion);
  const plan::JsonReader steps = root.Member("steps");
  const std::vector<certificate::EntryProof> proofs = ReadProofs(steps, plan.dimension);
  const std::size_t entries = plan.steps.size() + 1;
  if (proofs.size() > entries)
    steps.Fail("expected at most " + std::to_string(entries) + " steps as in the plan, found " +
               std::to_string(proofs.size()));

  plan::CheckOptions options = subject.check;
  options.judge_force_closure = false;
  const plan::PlanCheck check = plan::CheckPlan(subject.object, plan, options);
  ReportVerification verification;
  std::size_t proved = 0;
  for (const certificate::EntryVerdict& entry :
       certificate::CheckPlanProofs(check.projected, std::tan(plan.friction_angle), proofs)) {
    const std::string fault = FaultOf(check.steps[entry.index]);
    verification.text += std::to_string(entry.index) + " " + entry.kind + "  " +
                         (fault.empty() ? DescribeProofs(entry) : fault) + "\n";
    proved += fault.empty() && entry.proved() ? 1 : 0;
  }
  for (std::size_t i = proofs.size(); i < entries; ++i) {
    const plan::StepCheck& entry = check.steps[i];
    const std::string fault = FaultOf(entry);
    verification.text += std::to_string(i) + " " + entry.kind + "  " +
                         (fault.empty() ? "not proved: proof not found in the report" : fault) +
                         "\n";
  }
  verification.text += Summary(check.steps, proved, plan.friction_angle);
  verification.proved = proved == entries;
  return verification;
}

}  // namespace regrasp::apps
