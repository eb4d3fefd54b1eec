#pragma once

#include "apps/validate_options.h"

namespace regrasp::apps {

/// The file of verdicts in the folder of `validate --grasps`.
inline constexpr char kVerdictsName[] = "verdicts.npz";

/// Judges all grasps of an NPZ file analytically and writes the verdicts as arrays
/// (docs/formats.md).
/// @returns the exit code: whether all of them are on the object and force closure.
/// @throws InputError        a broken file, or one that does not fit the object.
/// @throws EnvironmentError  the verdicts cannot be written.
[[nodiscard]] int RunGrasps(const ValidateOptions& options);

}  // namespace regrasp::apps
