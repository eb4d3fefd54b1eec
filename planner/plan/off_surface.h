#pragma once

#include <Eigen/Core>
#include <string>

#include "planner/object/object.h"

namespace regrasp::plan {

/// How far a point is from the surface, for people: "0.004 of the object file's units off the
/// surface, 0.0385 of the object's diameter; up to 1e-06 of it counts as on it".
///
/// Nothing farther than kFarthestTold is measured: "more than 1000 of the object's diameters …".
[[nodiscard]] std::string OffSurfaceText(const object::Object& object,
                                         const Eigen::Vector3d& point);

/// Over the diameter: who is farther off has another object or another unit.
inline constexpr double kFarthestTold = 1000;

}  // namespace regrasp::plan
