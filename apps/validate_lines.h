#pragma once

#include "apps/validate_options.h"

namespace regrasp::apps {

/// The name of the file of lines in the folder of results.
inline constexpr char kReportsName[] = "reports.jsonl";

/// Validates every plan of a file of lines, in processes that share the objects that were loaded,
/// and writes reports.jsonl, a line for each. A plan whose frames are asked for also gets a folder
/// as a single validation makes it, named by its number, with plan.json in it.
/// @returns the exit code, as RunLinesFile.
/// @throws InputError        a file as RunLinesFile, an output that is an input.
/// @throws EnvironmentError  the folder cannot be written.
[[nodiscard]] int RunValidateLines(const ValidateOptions& options);

}  // namespace regrasp::apps
