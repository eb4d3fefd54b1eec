// The switching graph against rational arithmetic: generic and degenerate polygons, the same ones a
// little off, sets that only touch.

#include "tests/planner/contour/exact_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/planner/contour/outlines.h"

namespace regrasp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kSeed = 5;

/// An angle whose tangent is this very double.
double HalfAngleOf(double tangent) {
  double angle = std::atan(tangent);
  constexpr int kRoundings = 4;
  for (int k = 0; k < kRoundings && std::tan(angle) > tangent; ++k)
    angle = std::nextafter(angle, 0);
  for (int k = 0; k < kRoundings && std::tan(angle) < tangent; ++k) {
    angle = std::nextafter(angle, kInfinity);
  }
  EXPECT_EQ(std::tan(angle), tangent);
  return angle;
}

using Step = std::function<double(double, bool)>;

/// Every coordinate moved up or down by what `step` says.
Polygon Perturbed(const Polygon& polygon, const Step& step, std::mt19937_64& engine) {
  std::bernoulli_distribution up(0.5);
  return Mapped(polygon, [&](const Eigen::Vector2d& p) {
    const double x = step(p.x(), up(engine));
    return Eigen::Vector2d(x, step(p.y(), up(engine)));
  });
}

double OneRounding(double x, bool up) {
  if (x == 0) return x;  // the next double is no rounding of anything
  return std::nextafter(x, up ? kInfinity : -kInfinity);
}

Step By(double amount) {
  return [amount](double x, bool up) { return x + (up ? amount : -amount); };
}

void Check(const Polygon& polygon, double half_angle, OracleCounts& total) {
  const ContourGraph graph(polygon, half_angle);
  std::string difference;
  total += CompareWithRationals(polygon, graph, half_angle, difference);
  EXPECT_EQ(difference, "") << Degrees(half_angle) << "°";
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
    const Polygon polygon = IrregularOutline(30, 0.4, seed);
    for (const double degrees : {10.0, 20.0}) Check(polygon, Radians(degrees), total);
  }
  EXPECT_GT(total.pieces, 1500);
  EXPECT_GT(total.full, 100);
  EXPECT_GT(total.passages, 1000);
  EXPECT_GT(total.sets, 500);
  EXPECT_GT(total.switches, 800);
  EXPECT_GT(total.components, 100);
}

/// Exact ties at tan θ = 1/4, 1/2, 3/4, 1, 3/2, or as near as doubles come to a regular polygon.
std::vector<NamedPolygon> DegeneratePolygons() {
  std::vector<NamedPolygon> polygons;
  const auto add = [&](const std::string& name, std::vector<Ring> rings) {
    polygons.push_back({name, Polygon::FromRings(std::move(rings), name)});
  };
  for (const int n : {3, 4, 5, 6, 8, 12}) {
    polygons.push_back({"regular " + std::to_string(n), RegularPolygon(n)});
  }
  polygons.push_back({"fork", Fork()});
  add("square frame", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}});
  add("comb", {{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {0, 1}}});
  add("3-4-5", {{{0, 0}, {4, 0}, {8, 0}, {8, 3}, {4, 6}, {0, 3}}});
  // A staircase under a straight top: cells touch at corners where four of them meet.
  add("stairs",
      {{{0, 0}, {2, 0}, {2, 1}, {4, 1}, {4, 2}, {6, 2}, {6, 3}, {8, 3}, {8, 8}, {4, 8}, {0, 8}}});
  // Bottom and top cut into pieces of equal length: at tan θ = 1/4 the border of a cone goes
  // through corners of rectangles.
  add("bar", {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 4}, {3, 4}, {2, 4}, {1, 4}, {0, 4}}});
  return polygons;
}

TEST(ContourOracle, DegeneratePolygonsAreDecidedExactlyBeforeAndAfterPerturbation) {
  std::mt19937_64 engine(kSeed);
  OracleCounts total;
  const std::vector<std::pair<std::string, Step>> steps = {
      {"as it is", [](double x, bool) { return x; }},
      {"one rounding", OneRounding},
      {"1e-15", By(1e-15)},
      {"1e-12", By(1e-12)},
      {"1e-6", By(1e-6)}};
  for (const auto& [name, polygon] : DegeneratePolygons()) {
    for (const auto& [how, step] : steps) {
      SCOPED_TRACE(name + ", " + how);
      const Polygon moved = Perturbed(polygon, step, engine);
      for (const double half_angle : {HalfAngleOf(0.25), HalfAngleOf(0.5), Radians(30),
                                      HalfAngleOf(0.75), Radians(45), HalfAngleOf(1.5)}) {
        Check(moved, half_angle, total);
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
  const Polygon& blob = TwelveEdgePolygons()[4].polygon;
  std::string difference;
  const ContourGraph graph(blob, Radians(20));
  EXPECT_GT(CompareWithRationals(blob, graph, Radians(20), difference).sets, 0);
  EXPECT_EQ(difference, "");
  EXPECT_GT(CompareWithRationals(blob, graph, Radians(30), difference).sets, 0);
  EXPECT_NE(difference, "");
  const Polygon other = Mapped(blob, [](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(p.x() + 0.05 * p.y() * p.y(), p.y());
  });
  EXPECT_GT(CompareWithRationals(other, graph, Radians(20), difference).sets, 0);
  EXPECT_NE(difference, "");
}

}  // namespace
}  // namespace regrasp
