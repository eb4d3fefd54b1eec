#pragma once

#include <string>
#include <string_view>

#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// Result of checking a plan and the force-closure proofs of its report.
/// CheckPlan checks all other criteria. The proofs are checked against plan and object in exact
/// rational arithmetic.
struct ReportVerification {
  std::string text;     ///< text with a line per entry, and the conclusion
  bool proved = false;  ///< whether every entry of the plan is proved
};

/// Plan and object that a report must be about.
struct ReportSubject {
  const object::Object& object;
  std::string object_sha256;      ///< SHA-256 of the object file's bytes
  const plan::Plan& plan;         ///< plan with friction, torsion and fingers of the validation
  std::string plan_sha256;        ///< SHA-256 of the plan file's bytes
  plan::CheckOptions check = {};  ///< required start and goal
};

/// Verify a plan and the proofs in its report.
/// @param text  text of the report.
/// @param name  name of the report in messages.
/// @throws InputError  if the report is invalid, has no proofs, or is about another plan, object or
///     friction.
[[nodiscard]] ReportVerification VerifyReport(std::string_view text, const std::string& name,
                                              const ReportSubject& subject);

}  // namespace regrasp::apps
