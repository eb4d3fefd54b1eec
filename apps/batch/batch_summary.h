#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/batch/plan_library.h"
#include "apps/batch/report_summary.h"

namespace regrasp::apps {

/// Verdict on a plan of a batch, worst last. The value is the exit code of a validation of this
/// plan alone.
enum class PlanVerdict { kPass = 0, kFail = 1, kBadInput = 2, kError = 3 };

/// Return the verdict as written in the summary: "pass", "fail", "bad-input" or "error".
[[nodiscard]] std::string_view PlanVerdictName(PlanVerdict verdict);

struct PlanOutcome {
  std::string name;
  std::string file;  ///< name of the plan file
  PlanVerdict verdict = PlanVerdict::kError;
  std::optional<ReportSummary> report;  ///< report, if the plan passes or fails
  std::string message;                  ///< one-line message, for bad input or an error
  bool kept = false;                    ///< true if the report is that of an earlier run
  double seconds = 0;                   ///< wall-clock time of the validation in this run, s
  std::vector<double> entry_seconds;    ///< wall-clock times of the replayed steps, s
};

/// Outcomes of all plans of a batch, in their order.
struct BatchSummary {
  std::vector<PlanOutcome> plans;
  std::vector<SkippedFile> skipped;

  /// Return the worst verdict.
  [[nodiscard]] PlanVerdict verdict() const;
};

/// Return the counts: "31 pass, 2 fail, 0 bad-input, 0 error". Plans that pass although some of
/// their trials fail are counted separately.
[[nodiscard]] std::string CountsText(const BatchSummary& summary);

/// Format summary.json.
/// The same plans give the same bytes, regardless of reused results and of the number of jobs.
[[nodiscard]] std::string FormatSummaryJson(const BatchSummary& summary);

/// Format a readable table.
/// It has one row per plan, then the skipped files, then the number of plans per verdict.
[[nodiscard]] std::string FormatSummaryTable(const BatchSummary& summary);

/// Format JUnit XML with one test suite per plan.
/// A suite has a test case for each step of its report, or one error.
/// @param folder  folder of the plans' folders, as CI servers find it (PathForCi).
[[nodiscard]] std::string FormatSummaryJunit(const BatchSummary& summary,
                                             const std::filesystem::path& folder);

}  // namespace regrasp::apps
