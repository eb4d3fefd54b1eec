#pragma once

#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// Return true iff an edge has one triangle only.
/// @param soup  result of CleanSurface: no edge has more than two triangles.
[[nodiscard]] bool HasOpenEdges(const object::PolygonSoup& soup);

/// Return the shell of each triangle.
/// Shells share no vertex. They are numbered in the order of their first triangles.
[[nodiscard]] std::vector<int> ShellOfFacets(const object::PolygonSoup& soup);

/// Return the number of shells, that is of parts that share no vertex.
[[nodiscard]] int CountShells(const object::PolygonSoup& soup);

}  // namespace regrasp::repair
