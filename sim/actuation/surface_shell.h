#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::sim {

/// Return whether a solid is convex: it is connected by definition, and must be convex at each
/// edge.
[[nodiscard]] bool IsConvex(const object::Polyhedron& solid);

/// A tetrahedron: a triangle of a surface, counter-clockwise from outside, and a point below it.
using ShellPiece = std::array<Eigen::Vector3d, 4>;

/// Return convex pieces of a solid that together have its surface, in metres from the centroid.
///
/// Engines collide convex shapes only. The pieces replace a nonconvex solid for shapes that touch
/// it from outside. Each piece has a triangle of the surface as one side and its apex below the
/// triangle's centroid. The depth of the apex is the largest of kShellDepth, kShellDepth / 2, … at
/// which the piece does not cross the rest of the surface.
///
/// Law: every piece is inside the solid, up to one hundredth of its size. Pieces with a volume
/// below kLeastPiece are omitted, because MuJoCo refuses them.
/// @param scale  metres per unit of the solid.
[[nodiscard]] std::vector<ShellPiece> SurfaceShell(const object::Polyhedron& solid, double scale);

inline constexpr double kShellDepth = 0.005;  ///< metres, more than any fingertip is pressed in
inline constexpr double kLeastPiece = 1e-13;  ///< cubic metres

}  // namespace regrasp::sim
