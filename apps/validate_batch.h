#pragma once

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Validates each of many plans in a process of its own, into a folder of its own, and writes and
/// prints a summary of all. What goes wrong with one plan stops no other.
///
/// A batch that a signal stops writes no summary.
/// @returns the largest exit code of all plans; 3 also for a plan whose process crashed or was
/// stopped; 128 and its number where a signal stopped the batch and left this process alive.
/// @throws InputError        two plans of one name, a folder without plans.
/// @throws EnvironmentError  no processes, a folder that cannot be written.
[[nodiscard]] int RunBatch(const ValidateOptions& options);

}  // namespace regrasp::apps
