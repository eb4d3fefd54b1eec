#pragma once

#include <vector>

#include "apps/validate_options.h"

namespace regrasp::apps {

struct ValidationRun {
  int exit_code = 0;
  std::vector<double> entry_seconds;  ///< that each entry took, as far as they were replayed
};

/// Validates one plan (`plan_path`) or grasp as the options say: reads, checks, replays, draws,
/// writes the files, and prints the table.
///
/// The report is written last: where there is one, the files beside it are complete.
/// @throws InputError        a broken file, or one that does not go with the options.
/// @throws EnvironmentError  no rendering context, a folder that cannot be written.
[[nodiscard]] ValidationRun RunValidation(const ValidateOptions& options);

}  // namespace regrasp::apps
