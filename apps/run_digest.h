#pragma once

#include <string>

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
  std::string hand_sha256;   ///< of the file of --hand, likewise
};

/// The command as one could type it, but for where results go: "validate --object cube.obj --plan
/// plan.json --mu 0.4". Of files only the names.
[[nodiscard]] std::string CommandText(const ValidateOptions& options, const RunInputs& inputs);

/// SHA-256 over all that the results of a validation depend on: the program's build and the
/// engines, the bytes and names of plan (or grasp) and object, the bytes of --start and --goal, and
/// every other option that is given. Two runs with the same digest write the same bytes.
[[nodiscard]] std::string RunDigest(const ValidateOptions& options, const RunInputs& inputs);

}  // namespace regrasp::apps
