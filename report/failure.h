#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace regrasp::report {

/// Name of the reason of a plan whose steps pass and too few of whose trials do.
inline constexpr char kTrialsFailed[] = "trials-failed";

/// The first step of a plan that fails, or its trials, for people: the terminal, the page, the
/// pictures, report.json and JUnit say it in these words. A plan that passes has none.
struct Failure {
  plan::EntryIndex entry{0};  ///< not valid if all steps pass and too few trials do
  std::string kind;           ///< "hold", or as StepKind; "trials"
  std::string reason;         ///< "slipped", or kTrialsFailed
  /// With its number and unit: "finger 2 slipped by 300 µm under a push of 5.3 N along +x".
  std::string what;
  std::string why;   ///< what it is held against, and the likely cause where one was found
  std::string mend;  ///< what would make it pass

  /// "step 1 (align) fails: slipped: finger 2 slipped by 300 µm …".
  /// Of trials: "trials-failed: 6 of 20 trials with noise fail: 4 slipped, …".
  [[nodiscard]] std::string headline() const;
  /// Headline, why and what would mend it, on one line.
  [[nodiscard]] std::string line() const;
};

[[nodiscard]] std::optional<Failure> DescribeFailure(const Report& report);

/// Return the verdict in a line if it is more than "pass": the headline of the failure, or "pass in
/// 14 of 20 trials" if some trials fail; otherwise empty.
[[nodiscard]] std::string VerdictHeadline(const Report& report);

/// Return the heading of the overview image: "PASS in 14 of 20 trials: the hold and all 3 steps
/// stand", "FAIL at step 2: finger 2 slipped by …", "FAIL: 6 of 20 trials with noise fail: …".
[[nodiscard]] std::string HeadingText(const Report& report);

/// Three lines: what, why, what would mend it; empty where nothing fails.
[[nodiscard]] std::string FormatFailure(const Report& report);

}  // namespace regrasp::report
