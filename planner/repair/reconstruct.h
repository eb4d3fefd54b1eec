#pragma once

#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// True iff an edge has one facet.
/// @param soup  as CleanSurface makes it: no edge has more than two facets.
[[nodiscard]] bool HasOpenEdges(const object::PolygonSoup& soup);

/// Of each facet the part of the surface that it is in: parts have no vertex in common, and are
/// numbered in the order of their first facets.
[[nodiscard]] std::vector<int> ShellOfFacets(const object::PolygonSoup& soup);

/// How many parts of the surface there are that have no vertex in common.
[[nodiscard]] int CountShells(const object::PolygonSoup& soup);

}  // namespace regrasp::repair
