#pragma once

#include <string>
#include <string_view>

#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// A plan, checked as CheckPlan does in all but force closure, and the proofs of that in a report,
/// checked in exact rational arithmetic against plan and object.
struct ReportVerification {
  std::string text;     ///< a line per entry, and what all of them prove
  bool proved = false;  ///< every entry of the plan
};

/// The subject that a report must have.
struct ReportSubject {
  const object::Object& object;
  std::string object_sha256;      ///< of the object file's bytes
  const plan::Plan& plan;         ///< with friction, torsion and fingers of the validation
  std::string plan_sha256;        ///< of the plan file's bytes
  plan::CheckOptions check = {};  ///< required start and goal
};

/// @param text  of the report.
/// @param name  how messages call it.
/// @throws InputError  the report is broken, holds no proofs, or is about another plan, object or
///                     friction.
[[nodiscard]] ReportVerification VerifyReport(std::string_view text, const std::string& name,
                                              const ReportSubject& subject);

}  // namespace regrasp::apps
