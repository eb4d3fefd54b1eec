#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp {

/// x in [0, width], y in [0, height], first vertex at the origin; exact.
[[nodiscard]] Polygon Rectangle(double width, double height);

/// An upright fork of two prongs: 10 wide and 10 high, prongs 3 wide, a slot 4 wide and 7 deep.
/// Edges: 0 bottom, 1 right side, 2 right tip, 3 right inner side, 4 floor of the slot, 5 left
/// inner side, 6 left tip, 7 left side.
[[nodiscard]] Polygon Fork();

/// A regular polygon of circumradius `outer` with a concentric hole of as many edges, `inner`.
[[nodiscard]] Polygon Annulus(int n, double outer, double inner);

/// A simple polygon about the origin: shaken angles, radii anywhere between `least` and 1.
[[nodiscard]] Polygon IrregularOutline(int edges, double least, std::uint64_t seed);

/// Squares, triangles, letters, forks, rings, regular and irregular outlines, of 3 to 12 edges;
/// those with symmetries have exact ties.
[[nodiscard]] const std::vector<NamedPolygon>& TwelveEdgePolygons();

/// Exact ties at tan θ = 1/4, 1/2, 3/4, 1, 3/2, or as near as doubles come to a regular polygon;
/// cells that touch at corners where four of them meet.
[[nodiscard]] const std::vector<NamedPolygon>& DegeneratePolygons();

/// The polygon with every vertex replaced; rings that turn around are put right.
[[nodiscard]] Polygon Mapped(const Polygon& polygon,
                             const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& map);

/// How a coordinate is moved up or down.
using Shake = std::function<double(double coordinate, bool up)>;
[[nodiscard]] double OneRounding(double x, bool up);
[[nodiscard]] Shake By(double amount);

/// The polygon with every coordinate moved up or down by chance.
[[nodiscard]] Polygon Shaken(const Polygon& polygon, const Shake& shake, std::mt19937_64& engine);

/// The polygon with its rings started from the `by`-th vertex (of each, modulo their number).
[[nodiscard]] Polygon Renumbered(const Polygon& polygon, int by);

}  // namespace regrasp
