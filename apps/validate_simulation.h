#pragma once

#include <CLI/CLI.hpp>

#include "apps/validate_options.h"

namespace regrasp::apps {

/// Add the options of the replay: model, engine, disturbance test, trials and conditions.
void AddSimulation(CLI::App& app, ValidateOptions& options);

/// Check the options of the replay, and read the file of --conditions.
/// @throws InputError  if they are inconsistent, or the file is invalid.
void CheckSimulation(ValidateOptions& options, const CLI::App& app);

}  // namespace regrasp::apps
