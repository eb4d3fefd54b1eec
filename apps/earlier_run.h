#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/locked_output_folder.h"
#include "apps/validate_options.h"

namespace regrasp::apps {

/// Return whether a plan's folder has complete results of an equal earlier run.
/// The report must have the digest of this run. The report and all files that it names must be
/// unchanged, byte for byte.
[[nodiscard]] bool HasSameRun(const ValidateOptions& options);

/// Return the names of files in a folder that a validation wrote.
/// These are the report of an earlier validation, the files that it names, and the files that a
/// killed validation announced.
[[nodiscard]] std::set<std::string> OwnResults(const LockedOutputFolder& folder);

/// Return the names of files in a folder that a batch wrote.
/// These are its summary and its HTML report, if the summary names it.
[[nodiscard]] std::set<std::string> OwnSummary(const LockedOutputFolder& folder);

/// Check that writing the files replaces no files except `own` ones.
/// @throws InputError  if a folder, or a file that is not in `own`, has one of the names.
void ExpectFree(const LockedOutputFolder& folder, const std::set<std::string>& own,
                const std::vector<std::string>& names);

/// Remove `own` files and their incomplete versions that a killed process wrote.
/// All other files and all folders are kept.
/// @throws EnvironmentError  if one of them cannot be removed.
void RemoveEarlierRun(LockedOutputFolder& folder, const std::set<std::string>& own);

}  // namespace regrasp::apps
