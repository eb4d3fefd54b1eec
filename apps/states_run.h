#pragma once

#include "apps/validate_options.h"

namespace regrasp::apps {

/// The file of states in the folder of `validate --export-states`.
inline constexpr char kStatesName[] = "states.npz";

/// Makes reset states of a hand that holds an object, and writes them as arrays (docs/formats.md).
/// @returns the exit code: whether there are as many as asked for.
/// @throws InputError        the object is no solid, or the hand cannot be simulated.
/// @throws EnvironmentError  the states cannot be written.
[[nodiscard]] int RunStates(const ValidateOptions& options);

}  // namespace regrasp::apps
