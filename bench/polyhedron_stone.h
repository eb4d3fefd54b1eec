#pragma once

#include <Eigen/Core>

#include "planner/object/polyhedron.h"

namespace regrasp {

/// Generate a convex solid with exactly `faces` faces, three of which meet at each vertex.
/// The faces are tangent planes of the unit ball at points on a spiral, displaced randomly by the
/// seed. The solid is then stretched along the axes.
/// @param faces  number of faces, at least 6: fewer may not enclose a volume.
[[nodiscard]] object::Polyhedron MakeStone(int faces, const Eigen::Vector3d& stretch,
                                           unsigned seed);

}  // namespace regrasp
