#pragma once

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Return a surface in an order that its coordinates alone determine.
/// Vertices are sorted by coordinates, the corners of each polygon start at its first vertex, and
/// polygons are sorted by their vertices. The reason: the stage that unites shells orders them by
/// memory addresses, which depend on the calling program.
///
/// Law: the result does not depend on the numbering of vertices and polygons, nor on the corner at
/// which a polygon starts. Vertices at the same position keep their order.
[[nodiscard]] object::PolygonSoup InCanonicalOrder(const object::PolygonSoup& soup);

}  // namespace regrasp::repair
