#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/json.h"
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

  /// The index of the entry that failed; none where all passed.
  [[nodiscard]] std::optional<int> failed_step() const;
};

/// @param name  how messages call the report.
/// @throws InputError  it is no report.
[[nodiscard]] ReportSummary SummarizeReport(const Json& json, const std::string& name);

/// @throws InputError  the file cannot be read or is no report.
[[nodiscard]] ReportSummary ReadReportSummary(const std::filesystem::path& path);

}  // namespace regrasp::apps
