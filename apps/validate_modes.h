#pragma once

#include <CLI/CLI.hpp>

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Most of several plans that are validated at a time.
inline constexpr int kMostJobs = 1024;

/// Add the options of several plans.
void AddBatch(CLI::App& app, ValidateOptions& options);

// The modes of `validate` for grasps and states accept few options.

/// Adds the options of --export-states.
void AddStates(CLI::App& app, ValidateOptions& options);

/// @throws InputError  if an option is given that cannot be used with --grasps.
void CheckForGrasps(ValidateOptions& options, const CLI::App& app);

/// @throws InputError  the same for --export-states, or if there is no hand.
void CheckForStates(const ValidateOptions& options, const CLI::App& app);

}  // namespace regrasp::apps
