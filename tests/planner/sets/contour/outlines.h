#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/roundings.h"

namespace regrasp::contour {

/// Make the rectangle x in [0, width], y in [0, height] with exact coordinates and the first vertex
/// at the origin.
[[nodiscard]] object::Polygon Rectangle(double width, double height);

/// Make an upright fork with two prongs: 10 wide and 10 high, prongs 3 wide, a slot 4 wide and 7
/// deep.
///
/// Edges: 0 bottom, 1 right side, 2 right end, 3 right inner side, 4 floor of the slot, 5 left
/// inner side, 6 left end, 7 left side.
[[nodiscard]] object::Polygon Fork();

/// Make a regular polygon of circumradius `outer` with a concentric hole of circumradius `inner`
/// and as many edges.
[[nodiscard]] object::Polygon Annulus(int n, double outer, double inner);

/// Make a simple polygon about the origin with perturbed angles and random radii between `least`
/// and 1.
[[nodiscard]] object::Polygon IrregularOutline(int edges, double least, std::uint64_t seed);

/// Return squares, triangles, letters, forks, rings, regular and irregular outlines with 3 to 12
/// edges. Symmetric ones have exact ties.
[[nodiscard]] const std::vector<NamedPolygon>& TwelveEdgePolygons();

/// Return polygons with exact ties at tan θ = 1/4, 1/2, 3/4, 1 or 3/2, regular polygons rounded to
/// doubles, and cells that touch at corners at which four of them meet.
[[nodiscard]] const std::vector<NamedPolygon>& DegeneratePolygons();

/// Return the polygon with each ring starting at the `by`-th vertex, modulo the number of vertices.
[[nodiscard]] object::Polygon Renumbered(const object::Polygon& polygon, int by);

}  // namespace regrasp::contour
