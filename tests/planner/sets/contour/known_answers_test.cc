// Polygons whose sets, switches and largest squares are computed by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "planner/search/switching_graph.h"
#include "planner/sets/contour/contact_space.h"
#include "planner/sets/contour/region_diagram.h"
#include "tests/planner/sets/contour/graph_counts.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace known_answers_test {

using Eigen::Vector2d;

double LargestSize(const ContourGraph& graph, sets::SetIndex set) {
  double largest = 0;
  for (const DiagramEdge& edge : RegionMetric(graph, set).MakeDiagram()) {
    largest = std::max({largest, edge.from_size, edge.to_size});
  }
  return largest;
}

TEST(ContourKnownAnswers, OppositeSidesOfASquareUntilAdjacentOnesJoinThem) {
  for (const double degrees : {10.0, 20.0, 44.0}) {
    EXPECT_EQ(CountsOf(Square(4), degrees), (Counts{2, 2, 2, 0, 2})) << degrees;
  }
  EXPECT_EQ(CountsOf(Square(4), 46), (Counts{6, 6, 1, 0, 1}));
}

TEST(ContourKnownAnswers, ALongRectangleKeepsItsEndsApart) {
  for (const double degrees : {10.0, 20.0, 44.0}) {
    EXPECT_EQ(CountsOf(Rectangle(6, 2), degrees), (Counts{2, 2, 2, 0, 2})) << degrees;
  }
  // Grasps of adjacent sides connect the long sides around the corners, but not the grasps of both
  // ends. At 46°, the directions between the two ends are within 19°.
  EXPECT_EQ(CountsOf(Rectangle(6, 2), 46), (Counts{6, 6, 2, 1, 1}));
}

TEST(ContourKnownAnswers, AnEquilateralTriangleHasGraspsFrom30Degrees) {
  for (const double degrees : {10.0, 20.0, 29.9}) {
    EXPECT_EQ(CountsOf(RegularPolygon(3), degrees), (Counts{0, 0, 0, 0, 0})) << degrees;
  }
  // At 60° and more, the opposite side of a corner is inside both cones of the corner.
  for (const double degrees : {30.1, 35.0, 59.9}) {
    EXPECT_EQ(CountsOf(RegularPolygon(3), degrees), (Counts{3, 3, 3, 3, 1})) << degrees;
  }
  EXPECT_EQ(CountsOf(RegularPolygon(3), 60.1), (Counts{3, 3, 1, 0, 1}));
}

TEST(ContourKnownAnswers, ARegularHexagonIsOneSetFrom30Degrees) {
  for (const double degrees : {10.0, 20.0, 29.9}) {
    EXPECT_EQ(CountsOf(RegularPolygon(6), degrees), (Counts{3, 3, 3, 0, 3})) << degrees;
  }
  for (const double degrees : {30.1, 35.0, 50.0}) {
    EXPECT_EQ(CountsOf(RegularPolygon(6), degrees), (Counts{9, 9, 1, 0, 1})) << degrees;
  }
}

TEST(ContourKnownAnswers, AForkIsSqueezedAndStretched) {
  const object::Polygon fork = Fork();
  // At 10° the projections of the two ends on the bottom do not meet (4.76 and 5.24); at 20° they
  // do.
  EXPECT_EQ(CountsOf(fork, 10).switches, 6);
  EXPECT_EQ(CountsOf(fork, 20).switches, 7);
  const ContourGraph graph(fork, Radians(10));
  EXPECT_EQ(graph.components().count(), 2);
  std::set<std::tuple<int, int, bool>> pieces;
  for (const GraspPiece& p : graph.pieces()) {
    pieces.insert({p.edges[0], p.edges[1], p.stretching});
  }
  const std::set<std::tuple<int, int, bool>> expected = {
      {0, 2, false}, {0, 4, false}, {0, 6, false}, {1, 3, false},
      {1, 7, false}, {5, 7, false}, {3, 5, true}};
  EXPECT_EQ(pieces, expected);
  EXPECT_EQ(graph.vertex_count(), 7);
  EXPECT_TRUE(graph.passages().empty());
}

TEST(ContourKnownAnswers, TheLargestSquareBetweenParallelSides) {
  // Grasps of bottom and top of a square: |x + y − 4| < 4 tan θ, relative to the starts of the
  // edges.
  const object::Polygon square = Square(4);
  const ContourGraph graph(square, Radians(10));
  const double tangent = std::tan(Radians(10));
  ASSERT_EQ(graph.vertex_count(), 2);
  constexpr double kTolerance = 1e-10;  // lengths of the diagram are rounded to 1e-12 perimeters
  for (sets::SetIndex set{0}; set < 2; ++set) {
    EXPECT_NEAR(LargestSize(graph, set), 2 * tangent, kTolerance);
    const GraspPiece& piece = graph.pieces()[graph.pieces_of(set).front()];
    const Vector2d origin(graph.boundary().begin(piece.edges[0]),
                          graph.boundary().begin(piece.edges[1]));
    const RegionMetric metric(graph, set);
    EXPECT_NEAR(metric.SizeAt(origin + Vector2d(2, 2)), 2 * tangent, kTolerance);
    EXPECT_NEAR(metric.SizeAt(origin + Vector2d(0.25, 3.75)), 0.25, kTolerance);
    EXPECT_NEAR(metric.SizeAt(origin + Vector2d(2, 2.5)), 2 * tangent - 0.25, kTolerance);
  }
}

/// Return whether two ends of border segments are equal modulo the periods and the symmetry of
/// contact space.
bool SamePlace(const Boundary& boundary, Vector2d a, Vector2d b) {
  const double period = boundary.perimeter(RingIndex(0));
  const auto near = [&](double x, double y) {
    constexpr double kTolerance = 1e-9;
    return std::abs(std::remainder(x - y, period)) < kTolerance * period;
  };
  return (near(a.x(), b.x()) && near(a.y(), b.y())) || (near(a.x(), b.y()) && near(a.y(), b.x()));
}

/// Count the closed curves that bound a set of a polygon without holes.
int CurvesOf(const ContourGraph& graph, sets::SetIndex set) {
  const std::vector<BorderSegment> border = SetBorder(graph, set);
  const int count = static_cast<int>(border.size());
  std::vector<std::array<int, 2>> joined;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      const auto meets = [&](const Vector2d& a, const Vector2d& b) {
        return SamePlace(graph.boundary(), a, b);
      };
      if (meets(border[i].from, border[j].from) || meets(border[i].from, border[j].to) ||
          meets(border[i].to, border[j].from) || meets(border[i].to, border[j].to)) {
        joined.push_back({i, j});
      }
    }
  }
  return search::ComponentsOfEdges(count, joined).count();
}

TEST(ContourKnownAnswers, ADiscIsOneMoebiusBandWhoseWidthIsTheFrictionAngle) {
  for (const auto& [n, degrees] : {std::pair(12, 20.0), std::pair(12, 40.0), std::pair(60, 10.0),
                                   std::pair(60, 20.0), std::pair(128, 10.0)}) {
    SCOPED_TRACE(std::to_string(n) + " edges, " + std::to_string(degrees));
    const object::Polygon disc = RegularPolygon(n);
    const ContourGraph graph(disc, Radians(degrees));
    ASSERT_EQ(graph.vertex_count(), 1);
    EXPECT_EQ(std::ssize(graph.switches()), 0);
    EXPECT_EQ(graph.components().count(), 1);
    // A Möbius band has one border; an ordinary band would have two.
    EXPECT_EQ(CurvesOf(graph, sets::SetIndex(0)), 1);
    // Grasps on a circle of radius R: |y − x − πR| < 2 R θ.
    EXPECT_NEAR(LargestSize(graph, sets::SetIndex(0)), Radians(degrees),
                disc.face_measure(FaceIndex(0)));
  }
}

TEST(ContourKnownAnswers, AnAnnulusIsSqueezedAcrossItsRingAndStretchedInsideItsHole) {
  constexpr int kEdges = 60;
  constexpr double kOuter = 2;
  constexpr double kInner = 1;
  const object::Polygon annulus = Annulus(kEdges, kOuter, kInner);
  for (const double degrees : {10.0, 20.0}) {
    SCOPED_TRACE(degrees);
    const double angle = Radians(degrees);
    const ContourGraph graph(annulus, angle);
    ASSERT_EQ(graph.vertex_count(), 3);
    EXPECT_EQ(std::ssize(graph.switches()), 2);
    EXPECT_EQ(graph.components().count(), 1);
    // Sine rule in the triangle of the centre and the two contacts.
    const double turn = angle - std::asin(kInner * std::sin(angle) / kOuter);
    std::set<std::tuple<int, int, bool>> kinds;
    for (sets::SetIndex set{0}; set < 3; ++set) {
      const GraspPiece& piece = graph.pieces()[graph.pieces_of(set).front()];
      const int a = graph.boundary().ring_of(piece.edges[0]);
      const int b = graph.boundary().ring_of(piece.edges[1]);
      kinds.insert({a, b, piece.stretching});
      const double size = a != b   ? turn / (1 / kOuter + 1 / kInner)
                          : a == 0 ? kOuter * angle
                                   : kInner * angle;
      EXPECT_NEAR(LargestSize(graph, set), size, annulus.face_measure(FaceIndex(0))) << a << b;
    }
    const std::set<std::tuple<int, int, bool>> expected = {
        {0, 0, false}, {0, 1, false}, {1, 1, true}};
    EXPECT_EQ(kinds, expected);
  }
}

}  // namespace known_answers_test
}  // namespace regrasp::contour
