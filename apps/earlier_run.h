#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/held_folder.h"
#include "apps/validate_options.h"

namespace regrasp::apps {

/// Whether the folder of a plan holds the complete results of an earlier run that would come out
/// the same: a report with this run's digest, and all files that it names, each of them and the
/// report itself to the byte as they were written.
[[nodiscard]] bool HasSameRun(const ValidateOptions& options);

/// The results in a folder that are known to be ours: the report of an earlier validation and the
/// files that it names, and what a validation that was killed had announced.
[[nodiscard]] std::set<std::string> OwnResults(const HeldFolder& folder);

/// The same of a batch: its summary, and its page where the summary names one.
[[nodiscard]] std::set<std::string> OwnSummary(const HeldFolder& folder);

/// Makes sure that files can be written which may replace `own` ones and no others.
/// @throws InputError  a folder, or a file that is not of `own`, has one of the names.
void ExpectFree(const HeldFolder& folder, const std::set<std::string>& own,
                const std::vector<std::string>& names);

/// Removes `own` files and what a killed process left of them half-written. All else stays, and so
/// do folders.
/// @throws EnvironmentError  one of them cannot be removed.
void RemoveEarlierRun(HeldFolder& folder, const std::set<std::string>& own);

}  // namespace regrasp::apps
