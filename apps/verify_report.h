#pragma once

#include <string>
#include <string_view>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// The proofs in a report, checked in exact rational arithmetic against plan and object.
struct ReportVerification {
  std::string text;     ///< a line per entry, and a summary
  bool proved = false;  ///< every entry of the plan
};

/// What a report must be about.
struct ReportSubject {
  const Object& object;
  std::string object_sha256;  ///< of the object file's bytes
  const Plan& plan;
  std::string plan_sha256;  ///< of the plan file's bytes
};

/// @param text  of the report.
/// @param name  how messages call it.
/// @throws InputError  the report is broken, holds no proofs, or is about another plan or object.
[[nodiscard]] ReportVerification VerifyReport(std::string_view text, const std::string& name,
                                              const ReportSubject& subject);

}  // namespace regrasp
