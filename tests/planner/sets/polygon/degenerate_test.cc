// Degenerate polygons and slightly perturbed ones: parallel edges, equal normals, regular polygons,
// touching sets. The graph is compared with exact set operations and with answers known by
// construction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/fixtures/roundings.h"
#include "tests/planner/sets/polygon/graph_oracle.h"
#include "tests/planner/sets/polygon/shapes.h"
#include "tests/planner/sets/polygon/two_finger_oracle.h"

namespace regrasp::polygon {
namespace degenerate_test {

constexpr std::uint64_t kSeed = 3;

struct Checked {
  OracleCount concurrent;
  TwoFingerCount two_finger;
};

void Check(const object::Polygon& polygon, double friction_angle, planning::Spanning spanning,
           Checked& total) {
  const PolygonGraph graph(polygon, friction_angle, spanning);
  std::string difference;
  total.concurrent +=
      CompareWithSetOperations(polygon, graph, friction_angle, spanning, difference);
  EXPECT_EQ(difference, "");
  const TwoFingerCount count = CompareTwoFingerSets(polygon, graph, friction_angle, difference);
  EXPECT_EQ(difference, "");
  total.two_finger.candidates += count.candidates;
  total.two_finger.sets += count.sets;
  total.two_finger.switches += count.switches;
}

std::vector<NamedPolygon> DegeneratePolygons() {
  std::vector<NamedPolygon> polygons;
  const auto add = [&](const std::string& name, std::vector<Ring> rings) {
    polygons.push_back({name, object::Polygon::FromRings(std::move(rings), name)});
  };
  for (const int n : {3, 5, 6}) {
    polygons.push_back({"regular " + std::to_string(n), RegularPolygon(n)});
  }
  add("square frame", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}});
  add("comb", {{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {0, 1}}});
  // The hypotenuse's normal differs by 135° from both others, so φ* = 22.5°.
  add("right triangle", {{{0, 0}, {4, 0}, {0, 4}}});
  // Normals of 3-4-5 triangles, and two collinear edges.
  add("3-4-5", {{{0, 0}, {4, 0}, {8, 0}, {8, 3}, {4, 6}, {0, 3}}});
  return polygons;
}

TEST(Degenerate, CountsAreExactBeforeAndAfterPerturbation) {
  std::mt19937_64 engine(kSeed);
  Checked total;
  const std::vector<std::pair<std::string, std::function<double(double, bool)>>> steps = {
      {"as it is", [](double x, bool) { return x; }},
      {"one rounding", OneRounding},
      {"1e-12", By(1e-12)},
      {"1e-6", By(1e-6)}};
  for (const auto& [name, polygon] : DegeneratePolygons()) {
    for (const auto& [how, step] : steps) {
      const object::Polygon moved = Shaken(polygon, step, engine);
      for (const double friction_angle : {FrictionAngleOf(0.25), Radians(30), FrictionAngleOf(0.75),
                                          Radians(45), FrictionAngleOf(1.5)}) {
        for (const planning::Spanning spanning : kSpannings) {
          SCOPED_TRACE(name + ", " + how + ", " + std::to_string(Degrees(friction_angle)) + "° " +
                       Name(spanning));
          Check(moved, friction_angle, spanning, total);
        }
      }
    }
  }
  EXPECT_GT(total.concurrent.cells, 500);
  EXPECT_GT(total.concurrent.switches, 500);
  EXPECT_GT(total.two_finger.sets, 500);
  EXPECT_GT(total.two_finger.switches, 500);
}

}  // namespace degenerate_test
}  // namespace regrasp::polygon
