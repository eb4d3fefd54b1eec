#pragma once

#include <Eigen/Core>

#include "planner/collision/convex_shape.h"
#include "planner/collision/surface_tree.h"

namespace regrasp::sim {

/// Return whether a shape is deeper in a solid than allowed.
///
/// The depth is the length of the shortest translation that separates the shape from the surface,
/// over `outward` and 26 directions that are spread evenly. It is exact along `outward` and at most
/// an eighth too large otherwise. A shape that does not meet the surface has depth 0, so a shape
/// far inside the solid has to be noticed on its way there.
/// @param shape    In the solid's frame, metres.
/// @param depth    Allowed depth, metres.
/// @param outward  Direction of the surface normal near the shape, of length 1; zero if unknown.
[[nodiscard]] bool IsDeeperThan(const collision::SurfaceTree& surface,
                                const collision::ConvexShape& shape, double depth,
                                const Eigen::Vector3d& outward);

/// Return the depth of a shape in a solid, as IsDeeperThan measures it.
/// @returns metres, to 0.05 mm from above, no more than `most`.
[[nodiscard]] double DepthIn(const collision::SurfaceTree& surface,
                             const collision::ConvexShape& shape, double most,
                             const Eigen::Vector3d& outward);

}  // namespace regrasp::sim
