#pragma once

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// What becomes of parts of a solid that merely touch along an edge.
enum class Touching {
  kJoin,  ///< one body: its surface is drawn outwards there
  kPart,  ///< each is drawn back into its own inside
};

/// Moves the surface of a solid by kTouchingMoved · D along edges of more than two facets, and at
/// vertices where parts touch, so that every edge has two facets and every vertex one ring of them.
/// Parts that touch at vertices alone are drawn back from each other.
/// @param soup  triangles that bound a solid: as many along an edge as against it, and no two of
///              them in one place.
/// @throws std::runtime_error  about an edge inside and outside do not take turns.
[[nodiscard]] object::PolygonSoup ResolveTouching(const object::PolygonSoup& soup,
                                                  Touching touching);

/// Over the diameter: more than what is taken for the same point, a micrometre on what is 10 cm
/// across.
inline constexpr double kTouchingMoved = 1e-5;

}  // namespace regrasp::repair
