#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/batch/object_cache.h"
#include "apps/locked_output_folder.h"
#include "apps/validate_options.h"
#include "report/report.h"

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

/// Return the path of a plan's object.
/// It is `options.object_path`, or the file in that folder that the plan names.
/// @throws InputError  if the folder has no such file.
[[nodiscard]] std::string ObjectPathOf(const ValidateOptions& options,
                                       const std::string& named_by_plan);

/// Input files of a validation, with the contents that were used.
struct RunInputs {
  report::FileDigest input;  ///< name and digest of the plan or the grasp
  report::FileDigest object;
  std::string start_sha256;  ///< SHA-256 of the bytes of --start; empty if not given
  std::string goal_sha256;   ///< SHA-256 of the bytes of --goal; empty if not given
  /// SHA-256 of the file of --hand with its model and all included files
  std::string hand_sha256;
  std::string repair_sha256 = {};  ///< result of RepairInput
};

/// Return the digest of the module that repairs objects.
/// It is empty if neither the options nor the text of the plan require a repair.
[[nodiscard]] std::string RepairInput(const ValidateOptions& options, const std::string& plan_text);

/// Return the digest of --hand with its model and meshes; empty if not given.
/// @throws InputError  if the hand cannot be read.
[[nodiscard]] std::string HandInput(const ValidateOptions& options);

/// Return the command with file names only and without the paths of the results.
/// Example: "validate --object cube.obj --plan plan.json --mu 0.4".
[[nodiscard]] std::string CommandText(const ValidateOptions& options, const RunInputs& inputs);

/// Start a digest with the program's build and the engines.
[[nodiscard]] InputsDigest BuildDigest();

/// Return a SHA-256 over all inputs that the results of a validation depend on.
/// Two runs with the same digest write the same bytes. The inputs are:
///
/// - the program's build and the engines
/// - bytes and name of the plan (or grasp) and of the object
/// - bytes of --start, --goal and --hand with its model and meshes
/// - every other option with its value as typed
[[nodiscard]] std::string RunDigest(const ValidateOptions& options, const RunInputs& inputs);

}  // namespace regrasp::apps
