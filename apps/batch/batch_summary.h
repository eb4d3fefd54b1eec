#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/plan_library.h"
#include "apps/batch/report_summary.h"

namespace regrasp::apps {

/// What became of a plan of a batch, worst last; the value is the exit code of its validation
/// alone.
enum class PlanVerdict { kPass = 0, kFail = 1, kBadInput = 2, kError = 3 };

/// "pass", "fail", "bad-input" or "error", as the summary spells it.
[[nodiscard]] std::string_view PlanVerdictName(PlanVerdict verdict);

struct PlanOutcome {
  std::string name;
  std::string file;  ///< the plan file's name
  PlanVerdict verdict = PlanVerdict::kError;
  std::optional<ReportSummary> report;  ///< of a pass or a fail
  std::string message;                  ///< of bad input or an error, one line
  bool kept = false;                    ///< its report is of an earlier run
  double seconds = 0;                   ///< that this run took for it
  std::vector<double> entry_seconds;    ///< of those that it replayed
};

/// What a batch says of all its plans, in their order.
struct BatchSummary {
  std::vector<PlanOutcome> plans;
  std::vector<SkippedFile> skipped;

  /// The worst verdict.
  [[nodiscard]] PlanVerdict verdict() const;
};

/// "31 pass, 2 fail, 0 bad-input, 0 error", and how many pass although some of their trials fail.
[[nodiscard]] std::string CountsText(const BatchSummary& summary);

/// The text of summary.json. The same plans give the same bytes, whatever was kept and however
/// many ran at once.
[[nodiscard]] std::string FormatSummaryJson(const BatchSummary& summary);

/// A readable table: a line a plan, then what was skipped, then how many of each verdict.
[[nodiscard]] std::string FormatSummaryTable(const BatchSummary& summary);

/// JUnit XML: a suite a plan with a case for each entry of its report, or with one error.
/// @param folder  of the plans' folders, as CI servers find it (PathForCi).
[[nodiscard]] std::string FormatSummaryJunit(const BatchSummary& summary,
                                             const std::filesystem::path& folder);

}  // namespace regrasp::apps
