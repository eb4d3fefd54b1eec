#include "tests/planner/sets/polygon/shapes.h"

#include <cmath>
#include <numbers>

namespace regrasp {

const std::vector<NamedPolygon>& SmallPolygons() {
  static const std::vector<NamedPolygon> polygons = [] {
    std::vector<NamedPolygon> result;
    const auto add = [&](const std::string& name, std::vector<Ring> rings) {
      result.push_back({name, Polygon::FromRings(std::move(rings), name)});
    };
    add("triangle", {{{0, 0}, {5, 0.3}, {2.1, 4.2}}});
    add("quadrilateral", {{{0, 0}, {4, 0.5}, {4.6, 3.1}, {0.7, 3.9}}});
    add("dart", {{{0, 0}, {4.1, -1.3}, {2.2, 0.9}, {3.7, 3.4}}});
    add("arrow", {{{0, 0.2}, {3, 0}, {2.7, -1.4}, {5.5, 0.9}, {3.1, 3.2}, {3, 1.8}, {0.3, 1.9}}});
    add("blob", {{{0, 0},
                  {2, -0.6},
                  {3.1, 0.7},
                  {5, 0.4},
                  {4.3, 2.6},
                  {3, 2.2},
                  {2.6, 4.1},
                  {0.4, 3.7},
                  {0.9, 1.8}}});
    add("ring", {{{0, 0}, {5, 0.6}, {5.4, 4.2}, {0.8, 4.9}, {-0.9, 2.4}},
                 {{1.7, 1.6}, {2.1, 3.4}, {3.9, 2.9}, {3.5, 1.5}}});
    return result;
  }();
  return polygons;
}

Polygon RegularPolygon(int n) {
  Ring ring;
  for (int k = 0; k < n; ++k) {
    const double angle = -std::numbers::pi / 2 + (2 * k - 1) * std::numbers::pi / n;
    ring.emplace_back(std::cos(angle), std::sin(angle));
  }
  return Polygon::FromRings({ring}, "regular polygon");
}

Polygon Square(double size) {
  return Polygon::FromRings({{{0, 0}, {size, 0}, {size, size}, {0, size}}}, "square");
}

PolygonGraph MakeGraph(const Polygon& polygon, double degrees, Spanning spanning) {
  return PolygonGraph(polygon, Radians(degrees), spanning);
}

const char* Name(Spanning spanning) {
  return spanning == Spanning::kUniform ? "uniform" : "adaptive";
}

}  // namespace regrasp
