#pragma once

#include "planner/base/angle.h"

namespace regrasp::plan {

/// Normals in files must be of unit length within this (docs/formats.md).
inline constexpr double kNormalLengthTolerance = 1e-4;

/// Normals in files must be within this of a face's own normal, radians: 0.1° (docs/formats.md).
inline constexpr double kNormalTolerance = Radians(0.1);

/// Steps of single precision by which contacts may be off the surface: a point that was computed in
/// it, such as a point between the corners of a triangle, is rounded a few times.
inline constexpr double kSinglePrecisionSteps = 4;

/// Largest tolerance for points, over the object's diameter, however far the object is from the
/// origin.
inline constexpr double kLargestPointTolerance = 1e-3;

}  // namespace regrasp::plan
