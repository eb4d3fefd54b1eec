#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "report/report.h"

namespace regrasp::report {

enum class JunitOutcome { kPassed, kFailed, kError, kSkipped };

struct JunitCase {
  std::string name;
  JunitOutcome outcome = JunitOutcome::kPassed;
  std::string message;       ///< of a failure or an error, in a word or a line
  std::string text;          ///< of a failure, for people
  double seconds = 0;        ///< that it took; 0 where it was not carried out
  std::string picture = {};  ///< its file, of a failure; as the CI server finds it
};

/// The cases of one plan.
struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
  double seconds = 0;  ///< that all of it took, pictures and files too
};

/// What a case says for people, a line each; what is empty is left out.
/// @param detail  what failed; why, and what would mend it, as report.json has them.
[[nodiscard]] std::string JunitText(const std::string& detail, const std::string& why,
                                    const std::string& mend);

/// Of an entry's verdict, "pass", "fail" or "skipped".
[[nodiscard]] JunitOutcome OutcomeOf(std::string_view verdict);

/// A suite named after the plan with a case for each entry of its report; without times.
/// @param folder  of the report's frames, as CI servers find it (apps/output_files.h, PathForCi).
[[nodiscard]] JunitSuite MakeJunitSuite(const Report& report, const std::filesystem::path& folder);

/// How long the cases of a suite took, in their order; those at the end that were not carried out
/// may be missing.
void SetCaseTimes(const std::vector<double>& seconds, JunitSuite& suite);

/// JUnit XML for CI servers. The picture of a failure is named in its text, and attached to the
/// case in the form that GitLab and Jenkins' plugin junit-attachments read. Its times are the only
/// thing in it that differs from run to run.
[[nodiscard]] std::string FormatJunit(const std::vector<JunitSuite>& suites);

}  // namespace regrasp::report
