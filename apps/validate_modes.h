#pragma once

#include <CLI/CLI.hpp>

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Maximum number of plans that are validated simultaneously.
inline constexpr int kMostJobs = 1024;

/// Add the options of batches.
void AddBatch(CLI::App& app, ValidateOptions& options);

// The modes of `validate` for grasps and states accept few options.

/// Add the options of --export-states.
void AddStates(CLI::App& app, ValidateOptions& options);

/// Check the options of --grasps.
/// @throws InputError  if an option is given that cannot be used with --grasps.
void CheckForGrasps(ValidateOptions& options, const CLI::App& app);

/// Check the options of --export-states.
/// @throws InputError  if an option is given that cannot be used with it, or if there is no hand.
void CheckForStates(const ValidateOptions& options, const CLI::App& app);

}  // namespace regrasp::apps
