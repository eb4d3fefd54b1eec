#pragma once

#include <string>

#include "apps/batch/inputs_digest.h"
#include "apps/validate_options.h"
#include "report/report.h"

namespace regrasp::apps {

/// The object of a plan: `options.object_path`, or the file in that folder that the plan names.
/// @throws InputError  the folder has no such file.
[[nodiscard]] std::string ObjectPathOf(const ValidateOptions& options,
                                       const std::string& named_by_plan);

/// The files that the results of a validation come from, as they were used.
struct RunInputs {
  report::FileDigest input;  ///< the plan or the grasp
  report::FileDigest object;
  std::string start_sha256;  ///< of the bytes of --start; empty where it is not given
  std::string goal_sha256;   ///< of --goal, likewise
  /// Of the file of --hand, its model and all that this includes (HandModel::sha256).
  std::string hand_sha256;
  std::string repair_sha256 = {};  ///< as RepairInput
};

/// Return the digest of the module that repairs objects; empty if neither the options nor the text
/// of the plan ask for a repair.
[[nodiscard]] std::string RepairInput(const ValidateOptions& options, const std::string& plan_text);

/// Return the digest of --hand with its model and meshes; empty if it is not given.
/// @throws InputError  the hand cannot be read.
[[nodiscard]] std::string HandInput(const ValidateOptions& options);

/// The command as one could type it, but for where results go: "validate --object cube.obj --plan
/// plan.json --mu 0.4". Of files only the names.
[[nodiscard]] std::string CommandText(const ValidateOptions& options, const RunInputs& inputs);

/// Start a digest with the program's build and the engines.
[[nodiscard]] InputsDigest BuildDigest();

/// Return a SHA-256 over all that the results of a validation depend on: the program's build and
/// the engines, the bytes and names of plan (or grasp) and object, the bytes of --start, --goal and
/// --hand with its model and meshes, and every other option as it was typed. Two runs with the same
/// digest write the same bytes.
[[nodiscard]] std::string RunDigest(const ValidateOptions& options, const RunInputs& inputs);

}  // namespace regrasp::apps
