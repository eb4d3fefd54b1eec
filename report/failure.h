#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace regrasp::report {

/// The first step of a plan that fails, for people: the terminal, the page, the pictures,
/// report.json and JUnit say it in these words. A plan that passes has none.
struct Failure {
  plan::EntryIndex entry{0};
  std::string kind;    ///< "hold", or as StepKind
  std::string reason;  ///< "slipped"
  /// With its number and unit: "finger 2 slipped by 300 µm under a push of 5.3 N along +x".
  std::string what;
  std::string why;   ///< what it is held against, and the likely cause where one was found
  std::string mend;  ///< what would make it pass

  /// "step 1 (align) fails: slipped: finger 2 slipped by 300 µm …".
  [[nodiscard]] std::string headline() const;
};

[[nodiscard]] std::optional<Failure> DescribeFailure(const Report& report);

/// Three lines: what, why, what would mend it; empty where nothing fails.
[[nodiscard]] std::string FormatFailure(const Report& report);

}  // namespace regrasp::report
