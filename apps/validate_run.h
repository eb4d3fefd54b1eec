#pragma once

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Validates one plan (`plan_path`) or grasp as the options say: reads, checks, replays, draws,
/// writes the files, and prints the table.
///
/// The report is written last: where there is one, the files beside it are complete.
/// @returns the exit code.
/// @throws InputError        a broken file, or one that does not go with the options.
/// @throws EnvironmentError  no rendering context, a folder that cannot be written.
[[nodiscard]] int RunValidation(const ValidateOptions& options);

}  // namespace regrasp::apps
