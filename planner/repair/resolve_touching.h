#pragma once

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Treatment of parts of a solid that touch along an edge only.
enum class Touching {
  kJoin,  ///< one solid; the surface moves outwards at the edge
  kPart,  ///< separate solids: each surface is moved inwards at the edge
};

/// Separate the surface of a solid at its non-manifold edges and vertices.
/// In the result each edge has two triangles and each vertex one fan of triangles.
/// Moves the surface by kTouchingMoved · D along edges of more than two triangles and at vertices
/// where parts touch. Parts that touch at vertices only are always moved apart.
/// @param soup  triangles that bound a solid: each edge has equally many triangles in both
///     directions, and no two triangles coincide.
/// @throws std::runtime_error  if inside and outside do not alternate about an edge.
[[nodiscard]] object::PolygonSoup ResolveTouching(const object::PolygonSoup& soup,
                                                  Touching touching);

/// Displacement over the diameter.
/// Larger than the distance at which vertices are welded; 1 µm for an object of 10 cm.
inline constexpr double kTouchingMoved = 1e-5;

}  // namespace regrasp::repair
