#pragma once

#include <vector>

#include "apps/validate_options.h"

namespace regrasp::apps {

struct ValidationRun {
  int exit_code = 0;
  std::vector<double> entry_seconds;  ///< duration of each step that was replayed
};

/// Validate one plan (`plan_path`) or grasp with the options: read, check, replay, draw, write the
/// files, and print the table.
///
/// The report is written last. If it exists, the other files are complete.
/// @throws InputError        a file is broken, or does not fit the options.
/// @throws EnvironmentError  there is no rendering context, or a folder cannot be written.
[[nodiscard]] ValidationRun RunValidation(const ValidateOptions& options);

}  // namespace regrasp::apps
