#pragma once

#include <CLI/CLI.hpp>

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Most of several plans that are validated at a time.
inline constexpr int kMostJobs = 1024;

/// Adds what is about several plans.
void AddBatch(CLI::App& app, ValidateOptions& options);

// What `validate` does beside plans and single grasps takes few of its options.

/// Adds the options of --export-states.
void AddStates(CLI::App& app, ValidateOptions& options);

/// @throws InputError  an option is given that does not go with --grasps.
void CheckForGrasps(ValidateOptions& options, const CLI::App& app);

/// @throws InputError  the same of --export-states, or there is no hand.
void CheckForStates(const ValidateOptions& options, const CLI::App& app);

}  // namespace regrasp::apps
