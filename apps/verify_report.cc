#include "apps/verify_report.h"

#include <cmath>
#include <vector>

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/certificate/plan_proof.h"
#include "planner/plan/locate.h"

namespace regrasp {

namespace {

using Kind = ProofVerdict::Kind;

void ExpectDigest(const JsonReader& json, const std::string& sha256, const char* what) {
  const JsonReader digest = json.Member("sha256");
  if (digest.String() != sha256) {
    digest.Fail(std::string("the report is about another ") + what + ", " + digest.Quoted());
  }
}

/// The proofs of the first entries; what follows a failed one has none.
std::vector<EntryProof> ReadProofs(const JsonReader& steps, int dimension) {
  std::vector<EntryProof> proofs;
  for (const JsonReader& step : steps.Elements()) {
    if (!step.Has("proof")) break;
    proofs.push_back(ReadEntryProof(step.Member("proof"), dimension));
  }
  if (proofs.empty()) steps.Fail("holds no proofs; validate --certificates writes them");
  return proofs;
}

std::string Describe(const ProofVerdict& verdict) {
  if (verdict.kind == Kind::kForceClosure) return "proved";
  if (verdict.kind == Kind::kNotForceClosure) return "refuted";
  return "not proved: " + verdict.why;
}

std::string Line(const EntryVerdict& entry) {
  std::string line = std::to_string(entry.index) + " " + entry.kind + "  " + Describe(entry.rest);
  for (std::size_t k = 0; k < entry.ways.size(); ++k) {
    line += (k == 0 ? "; ways " : ", ") + Describe(entry.ways[k]);
  }
  return line + "\n";
}

}  // namespace

ReportVerification VerifyReport(std::string_view text, const std::string& name,
                                const ReportSubject& subject) {
  const Plan& plan = subject.plan;
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectFormat("regrasp-report");
  ExpectDigest(root.Member("object"), subject.object_sha256, "object");
  ExpectDigest(root.Member("plan"), subject.plan_sha256, "plan");
  const JsonReader angle = root.Member("settings").Member("friction_half_angle_deg");
  const double degrees = angle.Number();
  if (!(degrees > 0 && degrees < 90)) angle.Fail("must lie between 0 and 90");
  const JsonReader steps = root.Member("steps");
  const std::vector<EntryProof> proofs = ReadProofs(steps, plan.dimension);
  const std::size_t entries = plan.steps.size() + 1;
  if (proofs.size() > entries) steps.Fail("has more entries than the plan");

  ReportVerification verification;
  const double mu = std::tan(Radians(degrees));
  std::size_t proved = 0;
  for (const EntryVerdict& entry : CheckPlanProofs(LocatePlan(subject.object, plan), mu, proofs)) {
    verification.text += Line(entry);
    proved += entry.proved() ? 1 : 0;
  }
  verification.text += std::to_string(proved) + " of " + std::to_string(entries) +
                       " entries proved force closure in exact arithmetic, friction half-angle " +
                       FormatShort(degrees) + "°\n";
  verification.proved = proved == entries;
  return verification;
}

}  // namespace regrasp
