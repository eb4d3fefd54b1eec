#include "tests/planner/sets/contour/outlines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace regrasp::contour {
namespace {

Ring RegularRing(int n, double radius) {
  Ring ring;
  for (int k = 0; k < n; ++k) {
    const double angle = (2 * k - 1) * std::numbers::pi / n - std::numbers::pi / 2;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return ring;
}

}  // namespace

object::Polygon Rectangle(double width, double height) {
  return object::Polygon::FromRings({{{0, 0}, {width, 0}, {width, height}, {0, height}}},
                                    "rectangle");
}

object::Polygon Fork() {
  return object::Polygon::FromRings(
      {{{0, 0}, {10, 0}, {10, 10}, {7, 10}, {7, 3}, {3, 3}, {3, 10}, {0, 10}}}, "fork");
}

object::Polygon Annulus(int n, double outer, double inner) {
  return object::Polygon::FromRings({RegularRing(n, outer), RegularRing(n, inner)}, "annulus");
}

object::Polygon IrregularOutline(int edges, double least, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> shake(-0.4, 0.4);
  std::uniform_real_distribution<double> radius(least, 1);
  Ring ring;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * (k + shake(engine)) / edges;
    const double r = radius(engine);
    ring.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return object::Polygon::FromRings({ring}, "irregular outline");
}

const std::vector<NamedPolygon>& TwelveEdgePolygons() {
  static const std::vector<NamedPolygon> polygons = [] {
    std::vector<NamedPolygon> result = SmallPolygons();
    const auto add = [&](const std::string& name, std::vector<Ring> rings) {
      result.push_back({name, object::Polygon::FromRings(std::move(rings), name)});
    };
    result.push_back({"square", Square(4)});
    result.push_back({"equilateral triangle", RegularPolygon(3)});
    result.push_back({"regular hexagon", RegularPolygon(6)});
    add("L", {{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}}});
    result.push_back({"fork", Fork()});
    add("slanted fork",
        {{{0, 0}, {9, -1}, {10, 8}, {7.5, 9}, {6, 3}, {3.5, 2.5}, {2.2, 9}, {0, 8}}});
    add("square frame", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}});
    // Stretching grasps of edges that share a vertex.
    add("notch", {{{0, 0}, {8, 0}, {8, 5}, {4.6, 5}, {4, 1}, {3.2, 5}, {0, 5}}});
    for (const std::uint64_t seed : {11, 12, 13}) {
      result.push_back({"irregular " + std::to_string(seed), IrregularOutline(12, 0.35, seed)});
    }
    return result;
  }();
  return polygons;
}

const std::vector<NamedPolygon>& DegeneratePolygons() {
  static const std::vector<NamedPolygon> all = [] {
    std::vector<NamedPolygon> polygons;
    const auto add = [&](const std::string& name, std::vector<Ring> rings) {
      polygons.push_back({name, object::Polygon::FromRings(std::move(rings), name)});
    };
    for (const int n : {3, 4, 5, 6, 8, 12}) {
      polygons.push_back({"regular " + std::to_string(n), RegularPolygon(n)});
    }
    polygons.push_back({"fork", Fork()});
    add("square frame", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}});
    add("comb", {{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {0, 1}}});
    add("3-4-5", {{{0, 0}, {4, 0}, {8, 0}, {8, 3}, {4, 6}, {0, 3}}});
    // A staircase under a straight top: cells touch at corners at which four of them meet.
    add("stairs",
        {{{0, 0}, {2, 0}, {2, 1}, {4, 1}, {4, 2}, {6, 2}, {6, 3}, {8, 3}, {8, 8}, {4, 8}, {0, 8}}});
    // Bottom and top are divided into pieces of equal length: at tan θ = 1/4 the border of a cone
    // passes corners of rectangles.
    add("bar", {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 4}, {3, 4}, {2, 4}, {1, 4}, {0, 4}}});
    return polygons;
  }();
  return all;
}

object::Polygon Renumbered(const object::Polygon& polygon, int by) {
  std::vector<Ring> rings = polygon.rings();
  for (Ring& ring : rings) {
    std::rotate(ring.begin(), ring.begin() + by % static_cast<int>(ring.size()), ring.end());
  }
  return object::Polygon::FromRings(std::move(rings), "renumbered");
}

}  // namespace regrasp::contour
