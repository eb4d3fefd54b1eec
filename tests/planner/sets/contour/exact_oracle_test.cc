// Comparison of the switching graph with rational arithmetic: generic, degenerate and slightly
// perturbed polygons, and touching sets.

#include "tests/planner/sets/contour/exact_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/fixtures/roundings.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace exact_oracle_test {

constexpr std::uint64_t kSeed = 5;

void Check(const object::Polygon& polygon, double friction_angle, OracleCounts& total) {
  const ContourGraph graph(polygon, friction_angle);
  std::string difference;
  total += CompareWithRationals(polygon, graph, friction_angle, difference);
  EXPECT_EQ(difference, "") << Degrees(friction_angle) << "°";
}

TEST(ContourOracle, PiecesPassagesSetsAndSwitchesAreThoseOfRationalArithmetic) {
  OracleCounts total;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    SCOPED_TRACE(name);
    for (const double degrees : {3.0, 10.0, 15.0, 20.0, 35.0, 50.0, 65.0, 80.0}) {
      Check(polygon, Radians(degrees), total);
    }
  }
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    SCOPED_TRACE("irregular " + std::to_string(seed));
    const object::Polygon polygon = IrregularOutline(30, 0.4, seed);
    for (const double degrees : {10.0, 20.0}) Check(polygon, Radians(degrees), total);
  }
  EXPECT_GT(total.pieces, 1500);
  EXPECT_GT(total.full, 100);
  EXPECT_GT(total.passages, 1000);
  EXPECT_GT(total.sets, 500);
  EXPECT_GT(total.switches, 800);
  EXPECT_GT(total.components, 100);
}

TEST(ContourOracle, DegeneratePolygonsAreDecidedExactlyBeforeAndAfterPerturbation) {
  std::mt19937_64 engine(kSeed);
  OracleCounts total;
  const std::vector<std::pair<std::string, Shake>> steps = {
      {"as it is", [](double x, bool) { return x; }},
      {"one rounding", OneRounding},
      {"1e-15", By(1e-15)},
      {"1e-12", By(1e-12)},
      {"1e-6", By(1e-6)}};
  for (const auto& [name, polygon] : DegeneratePolygons()) {
    for (const auto& [how, step] : steps) {
      SCOPED_TRACE(name + ", " + how);
      const object::Polygon moved = Shaken(polygon, step, engine);
      for (const double friction_angle :
           {FrictionAngleOf(0.25), FrictionAngleOf(0.5), Radians(30), FrictionAngleOf(0.75),
            Radians(45), FrictionAngleOf(1.5)}) {
        Check(moved, friction_angle, total);
      }
    }
  }
  EXPECT_GT(total.pieces, 3000);
  EXPECT_GT(total.full, 100);
  EXPECT_GT(total.passages, 3000);
  EXPECT_GT(total.sets, 1000);
  EXPECT_GT(total.switches, 800);
}

TEST(ContourOracle, NoticesAGraphOfLessFrictionAndOfAnotherPolygon) {
  const object::Polygon& blob = TwelveEdgePolygons()[4].polygon;
  std::string difference;
  const ContourGraph graph(blob, Radians(20));
  EXPECT_GT(CompareWithRationals(blob, graph, Radians(20), difference).sets, 0);
  EXPECT_EQ(difference, "");
  EXPECT_GT(CompareWithRationals(blob, graph, Radians(30), difference).sets, 0);
  EXPECT_NE(difference, "");
  const object::Polygon other = Mapped(blob, [](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(p.x() + 0.05 * p.y() * p.y(), p.y());
  });
  EXPECT_GT(CompareWithRationals(other, graph, Radians(20), difference).sets, 0);
  EXPECT_NE(difference, "");
}

}  // namespace exact_oracle_test
}  // namespace regrasp::contour
