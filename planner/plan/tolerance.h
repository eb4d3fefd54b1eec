#pragma once

#include "planner/base/angle.h"

namespace regrasp::plan {

/// Normals in files must be of unit length within this (docs/formats.md).
inline constexpr double kNormalLengthTolerance = 1e-4;

/// Normals in files must be within this of a face's own normal, radians: 0.1° (docs/formats.md).
inline constexpr double kNormalTolerance = Radians(0.1);

}  // namespace regrasp::plan
