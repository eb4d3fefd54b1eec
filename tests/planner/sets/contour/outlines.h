#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "tests/fixtures/polygons.h"
#include "tests/fixtures/roundings.h"

namespace regrasp::contour {

/// x in [0, width], y in [0, height], first vertex at the origin; exact.
[[nodiscard]] object::Polygon Rectangle(double width, double height);

/// An upright fork of two prongs: 10 wide and 10 high, prongs 3 wide, a slot 4 wide and 7 deep.
/// Edges: 0 bottom, 1 right side, 2 right tip, 3 right inner side, 4 floor of the slot, 5 left
/// inner side, 6 left tip, 7 left side.
[[nodiscard]] object::Polygon Fork();

/// A regular polygon of circumradius `outer` with a concentric hole of as many edges, `inner`.
[[nodiscard]] object::Polygon Annulus(int n, double outer, double inner);

/// A simple polygon about the origin: shaken angles, radii anywhere between `least` and 1.
[[nodiscard]] object::Polygon IrregularOutline(int edges, double least, std::uint64_t seed);

/// Squares, triangles, letters, forks, rings, regular and irregular outlines, of 3 to 12 edges;
/// those with symmetries have exact ties.
[[nodiscard]] const std::vector<NamedPolygon>& TwelveEdgePolygons();

/// Exact ties at tan θ = 1/4, 1/2, 3/4, 1, 3/2, or as near as doubles come to a regular polygon;
/// cells that touch at corners where four of them meet.
[[nodiscard]] const std::vector<NamedPolygon>& DegeneratePolygons();

/// The polygon with its rings started from the `by`-th vertex (of each, modulo their number).
[[nodiscard]] object::Polygon Renumbered(const object::Polygon& polygon, int by);

}  // namespace regrasp::contour
