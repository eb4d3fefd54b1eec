#pragma once

#include <Eigen/Core>

#include "planner/object/polyhedron.h"

namespace regrasp {

/// A convex solid of exactly `faces` faces, a vertex where three meet: tangent planes of the unit
/// ball at points spread over it along a spiral and moved a little, by the seed; then stretched
/// along the axes.
/// @param faces  at least 6: fewer need not enclose anything.
[[nodiscard]] object::Polyhedron MakeStone(int faces, const Eigen::Vector3d& stretch,
                                           unsigned seed);

}  // namespace regrasp
