#pragma once

#include <optional>
#include <string>

#include "report/report.h"

namespace regrasp::report {

/// The first step of a plan that fails, for people; a plan that passes has none.
struct Failure {
  int step = 0;
  std::string what;  ///< "step 1 (align) fails: not-force-closure"
  std::string why;   ///< how far from passing, and the likely cause where one was found
  std::string mend;  ///< what would make it pass
};

[[nodiscard]] std::optional<Failure> DescribeFailure(const Report& report);

/// Three lines: what, why, what would mend it; empty where nothing fails.
[[nodiscard]] std::string FormatFailure(const Report& report);

}  // namespace regrasp::report
