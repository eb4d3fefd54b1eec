#pragma once

#include <string>

#include "apps/validate_options.h"
#include "sim/report.h"

namespace regrasp {

/// The object of a plan: `options.object_path`, or the file in that folder that the plan names.
/// @throws InputError  the folder has no such file.
[[nodiscard]] std::string ObjectPathOf(const ValidateOptions& options,
                                       const std::string& named_by_plan);

/// SHA-256 over all that the results of a validation depend on: the program's build and the engine,
/// the bytes and names of plan (or grasp) and object, the bytes of --start and --goal, and every
/// other option that is given. Two runs with the same digest write the same bytes.
/// @throws InputError  --start or --goal cannot be read.
[[nodiscard]] std::string RunDigest(const ValidateOptions& options, const FileDigest& input,
                                    const FileDigest& object);

}  // namespace regrasp
