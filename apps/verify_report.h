#pragma once

#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// The proofs in a report, checked in exact rational arithmetic against plan and object.
struct ReportVerification {
  std::string text;     ///< a line per entry, and a summary
  bool proved = false;  ///< every entry of the plan
};

/// @param plan_sha256  of the plan file's bytes.
/// @throws InputError  the report is broken, holds no proofs, or is about another plan or object.
[[nodiscard]] ReportVerification VerifyReport(const std::string& report_path,
                                              const ObjectFile& object, const Plan& plan,
                                              const std::string& plan_sha256);

}  // namespace regrasp
