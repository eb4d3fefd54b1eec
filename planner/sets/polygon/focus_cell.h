#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon.h"
#include "planner/sets/polygon/grasp_set.h"

namespace regrasp::polygon {

/// The focus cell of a concurrent set, rounded to doubles for drawing: a convex counter-clockwise
/// polygon for each of the set's parts, in their order.
///
/// At φ = φ* a cell may reach infinity; what is farther than `kFarthestFocus` diameters from the
/// centroid is cut off.
[[nodiscard]] std::vector<std::vector<Eigen::Vector2d>> FocusCell(const object::Polygon& polygon,
                                                                  const GraspSet& set);

inline constexpr double kFarthestFocus = 100;  ///< over D

}  // namespace regrasp::polygon
