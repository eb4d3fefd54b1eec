#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "report/failure.h"
#include "report/report.h"
#include "report/report_table.h"

namespace regrasp::apps {

/// Content of a report.json that a batch summary uses.
struct ReportSummary {
  struct Entry {
    std::string kind, verdict;
    std::string reason, detail;                ///< empty if there is none
    std::string frame;                         ///< name of the image file; empty if there is none
    std::string why = {}, suggested_fix = {};  ///< cause and suggested fix of a failed step
  };
  /// Repeats of the replay with noise, or replays under conditions.
  struct Trials {
    int count = 0;
    int passed = 0;
    std::string detail = {}, why = {}, suggested_fix = {};  ///< failure text if too few pass
    bool enough = true;
    bool decides = true;  ///< whether the verdict depends on them
  };
  bool passed = false;
  std::string object;                        ///< name of the object file
  std::string size;                          ///< size as text: "10.4 cm across, 216 g"
  std::string planner;                       ///< name of the planner; empty if not reported
  std::optional<double> friction_angle_deg;  ///< friction angle, degrees
  std::string run;  ///< digest of the inputs of the report; empty if not reported
  std::vector<report::FileDigest> files;  ///< other result files of the run
  std::vector<Entry> entries;
  std::optional<int> weakest_step;
  /// required friction angle of the weakest step, degrees
  std::optional<double> required_friction_angle_deg;
  std::optional<Trials> trials = std::nullopt;
  std::optional<Trials> conditions = std::nullopt;

  /// Return the index of the failed step; nullopt if all pass.
  [[nodiscard]] std::optional<int> failed_step() const;
  /// Return the failure, as described by the validation that wrote the report; nullopt if the plan
  /// passes.
  [[nodiscard]] std::optional<report::Failure> failure() const;
  /// Return the text after "pass": "in 14 of 20 trials, under 20 of 26 conditions"; empty without
  /// both.
  [[nodiscard]] std::string extent() const;
  /// Return the verdict as one line if it is more than "pass" (report::VerdictHeadline).
  [[nodiscard]] std::string headline() const;
};

/// @param name  name of the report in messages.
/// @throws InputError  if it is not a report.
[[nodiscard]] ReportSummary SummarizeReport(const Json& json, const std::string& name);

/// @throws InputError  if the file cannot be read or is not a report.
[[nodiscard]] ReportSummary ReadReportSummary(const std::filesystem::path& path);

}  // namespace regrasp::apps
