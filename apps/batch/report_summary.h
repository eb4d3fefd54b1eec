#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
#include "report/failure.h"
#include "report/report.h"

namespace regrasp::apps {

/// What a summary says of a report.json.
struct ReportSummary {
  struct Entry {
    std::string kind, verdict;
    std::string reason, detail;       ///< empty where there is none
    std::string frame;                ///< empty where there is none
    std::string why = {}, mend = {};  ///< of the one that failed
  };
  /// Repeats of the replay with noise.
  struct Trials {
    int count = 0;
    int passed = 0;
    std::string detail = {}, why = {}, mend = {};  ///< if too few passed
  };
  bool passed = false;
  std::string object;                    ///< the name of its file
  std::string size;                      ///< "10.4 cm across, 216 g"
  std::string planner;                   ///< empty where none is told
  std::optional<double> half_angle_deg;  ///< friction
  std::string run;  ///< the digest of what the report came from; empty where it gives none
  std::vector<report::FileDigest> files;  ///< the other results of its run
  std::vector<Entry> entries;
  std::optional<int> weakest_step;
  std::optional<double> required_half_angle_deg;  ///< of the weakest step
  std::optional<Trials> trials = std::nullopt;

  /// The index of the entry that failed; none where all passed.
  [[nodiscard]] std::optional<int> failed_step() const;
  /// How the plan fails, in the words of the validation that wrote the report; none if it passes.
  [[nodiscard]] std::optional<report::Failure> failure() const;
  /// "in 14 of 20 trials", behind "pass"; empty without trials.
  [[nodiscard]] std::string extent() const;
  /// The verdict in a line if it is more than "pass" (report::VerdictHeadline).
  [[nodiscard]] std::string headline() const;
};

/// @param name  how messages call the report.
/// @throws InputError  it is no report.
[[nodiscard]] ReportSummary SummarizeReport(const Json& json, const std::string& name);

/// @throws InputError  the file cannot be read or is no report.
[[nodiscard]] ReportSummary ReadReportSummary(const std::filesystem::path& path);

}  // namespace regrasp::apps
