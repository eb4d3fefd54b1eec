// Largest squares: comparison of the metric with corners of squares, and of the diagram with
// searches along lines and over grids.

#include "planner/sets/contour/region_diagram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/planner/sets/contour/held_contact.h"
#include "tests/planner/sets/contour/region_cases.h"
#include "tests/planner/sets/contour/square_oracle.h"

namespace regrasp::contour {
namespace region_diagram_test {

using Eigen::Vector2d;

constexpr std::uint64_t kSeed = 6;

/// Draw a point in the interior of an outline.
Vector2d DrawIn(const std::vector<Vector2d>& outline, std::mt19937_64& engine) {
  std::exponential_distribution<double> weight;
  Vector2d point = Vector2d::Zero();
  double sum = 0;
  for (const Vector2d& corner : outline) {
    const double w = weight(engine);
    point += w * corner;
    sum += w;
  }
  return point / sum;
}

TEST(RegionMetric, SizesAreThoseOfSquaresWhoseCornersAreGrasps) {
  constexpr int kPoints = 2;  // points per piece
  std::mt19937_64 engine(kSeed);
  int points = 0;
  int beyond_a_piece = 0;
  ForEachRegionGraph(
      [&](const object::Polygon& polygon, const ContourGraph& graph, double friction_angle) {
        const SquareOracle oracle(polygon, friction_angle);
        const double tolerance = SizeToleranceOf(polygon);
        for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
          const RegionMetric metric(graph, set);
          for (const PieceIndex piece : graph.pieces_of(set)) {
            const std::vector<Vector2d> outline = PieceOutline(graph, piece);
            ASSERT_FALSE(outline.empty());
            for (int k = 0; k < kPoints; ++k, ++points) {
              const Vector2d p = DrawIn(outline, engine);
              const double size = metric.SizeAt(p);
              EXPECT_NEAR(size, oracle.SizeAt(graph, piece, p), tolerance)
                  << "piece " << piece << " at " << p.transpose();
              const Boundary& boundary = graph.boundary();
              const FaceIndex edge = graph.pieces()[piece].edges[0];
              if (p.x() + size > boundary.end(edge) || p.x() - size < boundary.begin(edge)) {
                ++beyond_a_piece;
              }
            }
          }
        }
      });
  EXPECT_GT(points, 2000);
  EXPECT_GT(beyond_a_piece, 200);
}

TEST(RegionMetric, TheOracleRefusesSquaresThatAreLarger) {
  const object::Polygon square = Square(4);
  const double tangent = std::tan(Radians(10));
  const SquareOracle oracle(square, Radians(10));
  EXPECT_TRUE(oracle.Holds(0, 2, 0, 10, 1.999 * tangent));
  EXPECT_FALSE(oracle.Holds(0, 2, 0, 10, 2.001 * tangent));
  EXPECT_FALSE(oracle.Holds(0, 2, 0, 3, 0.001));
}

TEST(RegionDiagram, SizesAlongEveryEdgeAreThoseOfTheMetricAndOfTheCorners) {
  constexpr int kByCorners = 16;  // one of 16 edges is tested by corners
  int edges = 0;
  ForEachRegionGraph(
      [&](const object::Polygon& polygon, const ContourGraph& graph, double friction_angle) {
        const SquareOracle oracle(polygon, friction_angle);
        const double tolerance = SizeToleranceOf(polygon);
        for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
          const RegionMetric metric(graph, set);
          for (const DiagramEdge& edge : metric.MakeDiagram()) {
            EXPECT_EQ(graph.set_of(edge.piece), set);
            for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
              const Vector2d p = (1 - share) * edge.from + share * edge.to;
              EXPECT_NEAR(SizeOn(edge, share), metric.SizeAt(p), tolerance) << p.transpose();
            }
            if (edges++ % kByCorners != 0) continue;
            const Vector2d middle = (edge.from + edge.to) / 2;
            EXPECT_NEAR(SizeOn(edge, 0.5), oracle.SizeAt(graph, edge.piece, middle), tolerance);
          }
        }
      });
  EXPECT_GT(edges, 3000);
}

TEST(RegionDiagram, HoldsTheBestGraspWithOneContactHeld) {
  constexpr int kSamples = 40;
  constexpr int kDraws = 1;  // fixed contacts per contact of every piece
  std::mt19937_64 engine(kSeed);
  std::uniform_real_distribution<double> uniform(0, 1);
  int checked = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph, double) {
    SetGeometry geometry(graph);
    const double tolerance = SizeToleranceOf(polygon);
    for (PieceIndex piece{0}; piece < std::ssize(graph.pieces()); ++piece) {
      for (const int k : {0, 1}) {
        const auto range = geometry.RangeOf(piece, k);
        ASSERT_TRUE(range);
        for (int draw = 0; draw < kDraws; ++draw, ++checked) {
          const double at = range->low + uniform(engine) * (range->high - range->low);
          const HeldContact held(geometry, graph.set_of(piece), graph.pieces()[piece].edges[k], at);
          const HeldContact::Sampled sampled = held.Sample(kSamples);
          const double best = held.ByDiagram();
          EXPECT_GE(best, sampled.best - tolerance) << "piece " << piece << " at " << at;
          EXPECT_LE(best, sampled.best + sampled.spacing + tolerance);
        }
      }
    }
  });
  EXPECT_GT(checked, 2000);
}

double LargestSize(const std::vector<DiagramEdge>& diagram) {
  double largest = 0;
  for (const DiagramEdge& edge : diagram) {
    largest = std::max({largest, edge.from_size, edge.to_size});
  }
  return largest;
}

TEST(RegionDiagram, ItsLargestSquareIsThatOfAGridOfTheSet) {
  constexpr int kSteps = 16;  // steps per axis of every piece
  int sets = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph& graph, double) {
    for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set, ++sets) {
      const RegionMetric metric(graph, set);
      double best = 0;
      double spacing = 0;
      for (const PieceIndex piece : graph.pieces_of(set)) {
        const std::vector<Vector2d> outline = PieceOutline(graph, piece);
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vector2d& p : outline) {
          low = std::min(low, p.x());
          high = std::max(high, p.x());
        }
        for (int i = 0; i < kSteps; ++i) {
          const double x = low + (i + 0.5) / kSteps * (high - low);
          const auto section = SectionOf(outline, 0, x);
          if (!section) continue;
          const double step = (section->high - section->low) / kSteps;
          spacing = std::max({spacing, step, (high - low) / kSteps});
          for (int j = 0; j < kSteps; ++j) {
            best = std::max(best, metric.SizeAt({x, section->low + (j + 0.5) * step}));
          }
        }
      }
      const double largest = LargestSize(metric.MakeDiagram());
      EXPECT_GE(largest, best - SizeToleranceOf(polygon)) << "set " << set;
      EXPECT_LE(largest, best + spacing) << "set " << set;
    }
  });
  EXPECT_GT(sets, 300);
}

TEST(RegionDiagram, OfLessFrictionDoesNotHoldTheBestGrasp) {
  constexpr int kSamples = 40;
  const object::Polygon disc = RegularPolygon(40);
  const ContourGraph less(disc, Radians(10));
  const ContourGraph more(disc, Radians(12));
  SetGeometry geometry_of_less(less);
  SetGeometry geometry_of_more(more);
  const double at = disc.face_measure(FaceIndex(0)) / 3;
  EXPECT_LT(
      HeldContact(geometry_of_less, sets::SetIndex(0), FaceIndex(0), at).ByDiagram(),
      HeldContact(geometry_of_more, sets::SetIndex(0), FaceIndex(0), at).Sample(kSamples).best);
}

TEST(RegionDiagram, DoesNotDependOnWhereARingBegins) {
  const auto largest_sizes = [](const object::Polygon& polygon, double friction_angle) {
    const ContourGraph graph(polygon, friction_angle);
    std::vector<double> sizes;
    for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
      sizes.push_back(LargestSize(RegionMetric(graph, set).MakeDiagram()));
    }
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  };
  int sets = 0;
  ForEachRegionGraph([&](const object::Polygon& polygon, const ContourGraph&,
                         double friction_angle) {
    const std::vector<double> sizes = largest_sizes(polygon, friction_angle);
    for (const int by : {1, 2, 3}) {
      const std::vector<double> renumbered = largest_sizes(Renumbered(polygon, by), friction_angle);
      ASSERT_EQ(renumbered.size(), sizes.size());
      for (std::size_t i = 0; i < sizes.size(); ++i, ++sets) {
        EXPECT_NEAR(renumbered[i], sizes[i], SizeToleranceOf(polygon));
      }
    }
  });
  EXPECT_GT(sets, 1000);
}

}  // namespace region_diagram_test
}  // namespace regrasp::contour
