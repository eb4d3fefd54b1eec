#pragma once

#include <string>

#include "planner/object/object.h"

namespace regrasp::plan {

/// Number of single-precision units in the last place by which contacts may be off the surface. A
/// computed point, such as one between the corners of a triangle, is rounded a few times.
inline constexpr double kSinglePrecisionSteps = 4;

/// Largest tolerance for points, over the object's diameter, at any distance of the object from the
/// origin.
inline constexpr double kLargestPointTolerance = 1e-3;

/// Return how far a given point may be from the object's surface and still count as on it.
///
/// This is kPointTolerance · D, or the rounding of coordinates in single precision if that is
/// larger: kSinglePrecisionSteps · 2⁻²³ · (c + D), c the largest coordinate of the centroid, at
/// most kLargestPointTolerance · D. The second is larger for objects more than 1.1 D from the
/// origin.
/// @returns a length in the object's unit.
[[nodiscard]] double SurfaceTolerance(const object::Object& object);

/// Describe how far a point is off the surface, with the tolerance.
/// Example: "off the surface, expected at most 1e-06 of the object's diameter, found 0.0002887
/// (0.001 in the object file's unit)".
/// @param point  point in the object's frame and unit.
[[nodiscard]] std::string OffSurfaceText(const object::Object& object,
                                         const Eigen::Vector3d& point);

}  // namespace regrasp::plan
