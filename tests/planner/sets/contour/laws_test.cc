// Laws of the contour graph: invariants and monotonicity.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "tests/planner/sets/contour/contact_grid.h"
#include "tests/planner/sets/contour/graph_counts.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace laws_test {

using Eigen::Vector2d;

constexpr double kAngles[] = {10, 20, 35, 50};
constexpr std::uint64_t kSeed = 4;

/// Return the twelve-edge polygons and several of 40 edges.
const std::vector<NamedPolygon>& Polygons() {
  static const std::vector<NamedPolygon> polygons = [] {
    std::vector<NamedPolygon> result = TwelveEdgePolygons();
    for (const std::uint64_t seed : {21, 22}) {
      result.push_back({"irregular " + std::to_string(seed), IrregularOutline(40, 0.5, seed)});
    }
    return result;
  }();
  return polygons;
}

/// Compare counts before and after a change, for every polygon and angle. @returns number of
/// compared vertices.
template <class Change>
std::int64_t ExpectSameCounts(const Change& change) {
  std::int64_t vertices = 0;
  for (const auto& [name, polygon] : Polygons()) {
    for (const double degrees : kAngles) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const Counts before = CountsOf(polygon, degrees);
      EXPECT_EQ(CountsOf(change(polygon), degrees), before);
      vertices += before.vertices;
    }
  }
  return vertices;
}

TEST(ContourLaws, CountsDoNotDependOnWhereTheEdgesAreNumberedFrom) {
  for (const int by : {1, 2, 5}) {
    EXPECT_GT(ExpectSameCounts([by](const object::Polygon& p) { return Renumbered(p, by); }), 300);
  }
}

TEST(ContourLaws, CountsDoNotDependOnMirroringTurningBy90DegreesAndScalingByPowersOfTwo) {
  const auto with = [](auto map) {
    return ExpectSameCounts([map](const object::Polygon& p) { return Mapped(p, map); });
  };
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(-p.x(), p.y()); }), 300);
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(p.y(), p.x()); }), 300);
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(-p.y(), p.x()); }), 300);
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(-p); }), 300);
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(0x1p-20 * p); }), 300);
  EXPECT_GT(with([](const Vector2d& p) { return Vector2d(0x1p30 * p); }), 300);
}

TEST(ContourLaws, TheLawsNoticeAPolygonThatIsStretched) {
  const object::Polygon& blob = TwelveEdgePolygons()[4].polygon;
  const object::Polygon stretched =
      Mapped(blob, [](const Vector2d& p) { return Vector2d(2 * p.x(), p.y()); });
  EXPECT_NE(CountsOf(stretched, 20), CountsOf(blob, 20));
}

/// Round the polygon to even coordinates, so that the middle of every edge is exact.
object::Polygon Even(const object::Polygon& polygon) {
  const double grid = std::ldexp(polygon.diameter(), -20);
  return Mapped(polygon, [grid](const Vector2d& p) {
    return Vector2d(2 * std::round(p.x() / grid), 2 * std::round(p.y() / grid));
  });
}

object::Polygon CutInTwo(const object::Polygon& polygon, std::mt19937_64& engine) {
  std::vector<Ring> rings = polygon.rings();
  std::bernoulli_distribution cut(0.4);
  for (Ring& ring : rings) {
    Ring longer;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      longer.push_back(ring[k]);
      if (k == 0 || cut(engine)) longer.push_back((ring[k] + ring[(k + 1) % ring.size()]) / 2);
    }
    ring = longer;
  }
  return object::Polygon::FromRings(rings, "cut in two");
}

TEST(ContourLaws, AnEdgeCutInTwoChangesNoSetAndNoSwitch) {
  std::mt19937_64 engine(kSeed);
  std::int64_t vertices = 0;
  std::int64_t more_combinations = 0;
  for (const auto& [name, polygon] : Polygons()) {
    const object::Polygon even = Even(polygon);
    const object::Polygon cut = CutInTwo(even, engine);
    for (const double degrees : kAngles) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const Counts before = CountsOf(even, degrees);
      const Counts after = CountsOf(cut, degrees);
      EXPECT_EQ(after.vertices, before.vertices);
      EXPECT_EQ(after.switches, before.switches);
      EXPECT_EQ(after.components, before.components);
      EXPECT_GE(after.combinations, before.combinations);
      vertices += before.vertices;
      more_combinations += after.combinations - before.combinations;
    }
  }
  EXPECT_GT(vertices, 300);
  EXPECT_GT(more_combinations, 300);
}

TEST(ContourLaws, NoGraspIsLostWithMoreFrictionAndSetsOnlyMerge) {
  constexpr int kLines = 150;
  std::int64_t grasps = 0;
  for (const auto& [name, polygon] : TwelveEdgePolygons()) {
    for (std::size_t k = 0; k + 1 < std::size(kAngles); ++k) {
      SCOPED_TRACE(name + " " + std::to_string(kAngles[k]));
      const ContourGraph less(polygon, Radians(kAngles[k]));
      const ContourGraph more(polygon, Radians(kAngles[k + 1]));
      std::map<int, int> merged;
      for (PieceIndex p{0}; p < std::ssize(less.pieces()); ++p) {
        const GraspPiece& piece = less.pieces()[p];
        int found = -1;
        for (const PieceIndex q : more.PiecesOn(piece.edges[1], piece.edges[0])) {
          if (more.pieces()[q].stretching == piece.stretching) found = more.set_of(q);
        }
        ASSERT_GE(found, 0) << "piece " << p << " is lost";
        const int into = merged.try_emplace(less.set_of(p), found).first->second;
        EXPECT_EQ(into, found) << "set " << less.set_of(p) << " falls apart";
      }
      for (const auto& [v, w] : less.switches()) {
        if (merged[v] == merged[w]) continue;
        std::vector<int> neighbours;
        more.GetNeighbours(merged[v], neighbours);
        EXPECT_EQ(std::count(neighbours.begin(), neighbours.end(), merged[w]), 1);
      }
      // Grasps at less friction are in pieces at more friction.
      const ContactGrid grid(polygon, Radians(kAngles[k]), kLines, kSeed);
      for (int i = 0; i < grid.line_count(); ++i) {
        for (int j = 0; j < i; ++j) {
          if (grid.component(i, j) < 0) continue;
          EXPECT_FALSE(more.PiecesOn(grid.line(i).face, grid.line(j).face).empty());
          ++grasps;
        }
      }
    }
  }
  EXPECT_GT(grasps, 30'000);
}

TEST(ContourLaws, NeighboursAreMutualSortedAndThoseOfTheSwitches) {
  std::int64_t switches = 0;
  for (const auto& [name, polygon] : Polygons()) {
    for (const double degrees : kAngles) {
      SCOPED_TRACE(name + " " + std::to_string(degrees));
      const ContourGraph graph(polygon, Radians(degrees));
      EXPECT_TRUE(std::is_sorted(graph.switches().begin(), graph.switches().end()));
      std::set<std::array<int, 2>> found;
      std::vector<int> neighbours;
      for (sets::SetIndex v{0}; v < graph.vertex_count(); ++v) {
        graph.GetNeighbours(v, neighbours);
        EXPECT_TRUE(std::is_sorted(neighbours.begin(), neighbours.end()));
        for (const int w : neighbours) {
          EXPECT_NE(v, w);
          EXPECT_TRUE(found.insert({v, w}).second) << "listed twice";
        }
      }
      for (const auto& [v, w] : graph.switches()) {
        EXPECT_LT(v, w);
        EXPECT_TRUE(found.contains({v, w}) && found.contains({w, v}));
      }
      EXPECT_EQ(std::ssize(found), 2 * std::ssize(graph.switches()));
      switches += std::ssize(graph.switches());
    }
  }
  EXPECT_GT(switches, 300);
}

TEST(ContourLaws, PiecesAreFoundInAnyOrderOfTheirEdges) {
  const object::Polygon& blob = TwelveEdgePolygons()[4].polygon;
  const ContourGraph graph(blob, Radians(50));
  int found = 0;
  for (FaceIndex a{0}; a < blob.face_count(); ++a) {
    EXPECT_TRUE(graph.PiecesOn(a, a).empty());
    for (FaceIndex b{0}; b < a; ++b) {
      EXPECT_EQ(graph.PiecesOn(a, b), graph.PiecesOn(b, a));
      found += static_cast<int>(graph.PiecesOn(a, b).size());
    }
  }
  EXPECT_EQ(found, std::ssize(graph.pieces()));
  EXPECT_GT(found, 10);
}

TEST(ContourLaws, FrictionOutsideItsRangeIsRefused) {
  const object::Polygon square = Square(1);
  for (const double angle : {0.0, -0.1, Radians(90), 2.0, std::nan("")}) {
    EXPECT_THROW(ContourGraph(square, angle), std::invalid_argument) << angle;
  }
}

}  // namespace laws_test
}  // namespace regrasp::contour
