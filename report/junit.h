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
  double seconds = 0;   ///< that it took; 0 where it was not carried out
};

/// The cases of one plan.
struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
  double seconds = 0;  ///< that all of it took, pictures and files too
};

/// What a case says for people, a line each; what is empty is left out.
/// @param detail   what failed; why, and what would mend it, as report.json has them.
/// @param picture  where the picture is.
[[nodiscard]] std::string JunitText(const std::string& detail, const std::string& why,
                                    const std::string& mend, const std::string& picture);

/// Of an entry's verdict, "pass", "fail" or "skipped".
[[nodiscard]] JunitOutcome OutcomeOf(std::string_view verdict);

/// A suite named after the plan with a case for each entry of its report; without times.
[[nodiscard]] JunitSuite MakeJunitSuite(const Report& report);

/// How long the cases of a suite took, in their order; those at the end that were not carried out
/// may be missing.
void SetCaseTimes(const std::vector<double>& seconds, JunitSuite& suite);

/// JUnit XML for CI servers. Its times are the only thing in it that differs from run to run.
[[nodiscard]] std::string FormatJunit(const std::vector<JunitSuite>& suites);

}  // namespace regrasp::report
