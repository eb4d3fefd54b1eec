#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace regrasp::report {

enum class JunitOutcome { kPassed, kFailed, kError, kSkipped };

struct JunitCase {
  std::string name;
  JunitOutcome outcome = JunitOutcome::kPassed;
  std::string message;  ///< of a failure or an error, in a word or a line
  std::string text;     ///< of a failure, for people
};

/// The cases of one plan.
struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
};

/// What a case says for people: the detail, and the picture where there is one.
/// @param picture  where the picture is; may be empty.
[[nodiscard]] std::string JunitText(const std::string& detail, const std::string& picture);

/// Of an entry's verdict, "pass", "fail" or "skipped".
[[nodiscard]] JunitOutcome OutcomeOf(std::string_view verdict);

/// A suite named after the plan with a case for each entry of its report.
[[nodiscard]] JunitSuite MakeJunitSuite(const Report& report);

/// JUnit XML for CI servers.
[[nodiscard]] std::string FormatJunit(const std::vector<JunitSuite>& suites);

}  // namespace regrasp::report
