#pragma once

#include <string>

#include "planner/object/object.h"

namespace regrasp::plan {

/// Steps of single precision by which contacts may be off the surface: a point that was computed in
/// it, such as a point between the corners of a triangle, is rounded a few times.
inline constexpr double kSinglePrecisionSteps = 4;

/// Largest tolerance for points, over the object's diameter, however far the object is from the
/// origin.
inline constexpr double kLargestPointTolerance = 1e-3;

/// Return how far a given point may be from the object's surface and still count as on it.
///
/// This is kPointTolerance · D, or what coordinates in single precision lose if that is more:
/// kSinglePrecisionSteps · 2⁻²³ · (c + D), c the largest coordinate of the centroid, at most
/// kLargestPointTolerance · D. The second is larger for objects more than 1.1 D from the origin.
/// @returns a length in the object's unit.
[[nodiscard]] double SurfaceTolerance(const object::Object& object);

/// Describe for people how far a point is off the surface, with the tolerance: "0.001 of the object
/// file's units off the surface, …".
/// @param point  in the object's frame and unit.
[[nodiscard]] std::string OffSurfaceText(const object::Object& object,
                                         const Eigen::Vector3d& point);

}  // namespace regrasp::plan
