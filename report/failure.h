#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace regrasp::report {

/// Name of the reason of a plan whose steps pass but too few of whose trials pass.
inline constexpr char kTrialsFailed[] = "trials-failed";

/// First failing step of a plan, or its failing trials, as readable text.
/// The terminal, the HTML report, the images, report.json and JUnit use the same text. A plan that
/// passes has none.
struct Failure {
  plan::EntryIndex entry{0};  ///< failed entry; invalid if only the trials fail
  std::string kind;           ///< "hold", or as StepKind; "trials"
  std::string reason;         ///< "slipped", or kTrialsFailed
  /// Description of the fault with number and unit: "finger 2 slipped by 300 µm".
  std::string what;
  std::string why;            ///< limit that is exceeded, and the likely cause if one was found
  std::string suggested_fix;  ///< suggested fix

  /// Return "step 1 (align) fails: slipped: finger 2 slipped by 300 µm …". For trials:
  /// "trials-failed: 6 of 20 trials with noise fail: 4 slipped, …".
  [[nodiscard]] std::string headline() const;
  /// Return headline, reason and suggested fix, on one line.
  [[nodiscard]] std::string line() const;
};

[[nodiscard]] std::optional<Failure> DescribeFailure(const Report& report);

/// Return the verdict in a line if it is more than "pass", otherwise nothing.
/// It is the headline of the failure, or "pass in 14 of 20 trials" if some trials fail.
[[nodiscard]] std::string VerdictHeadline(const Report& report);

/// Return the heading of the overview image.
/// Examples: "PASS in 14 of 20 trials: the hold and all 3 steps stand", "FAIL at step 2: finger 2
/// slipped by …", "FAIL: 6 of 20 trials with noise fail: …".
[[nodiscard]] std::string HeadingText(const Report& report);

/// Return three lines (fault, reason, suggested fix); empty if nothing fails.
[[nodiscard]] std::string FormatFailure(const Report& report);

}  // namespace regrasp::report
