#pragma once

#include "planner/object/polygon_soup.h"

namespace regrasp::repair {

/// A surface in an order that its coordinates alone decide: vertices by coordinates, each facet's
/// corners from the first of its vertices on, facets by their vertices. What unites shells puts
/// them in an order that depends on addresses in memory, and so on the program that calls it.
///
/// Law: however vertices and facets are numbered, and whichever corner a facet begins with, the
/// result is the same. Vertices at one place keep their order.
[[nodiscard]] object::PolygonSoup InCanonicalOrder(const object::PolygonSoup& soup);

}  // namespace regrasp::repair
