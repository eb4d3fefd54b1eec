// Comparison of the switching graph with random grasps of small polygons.

#include "tests/planner/sets/polygon/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace brute_force_test {

constexpr int kPairs = 150;    // pairs of contacts per two edges
constexpr int kThirds = 4;     // third contacts per pair and edge
constexpr int kPoints = 20;    // focus points per convex part of a cell
constexpr int kSearch = 2000;  // draws per missing vertex or switch
constexpr std::uint64_t kSeed = 1;

/// Fraction of switches, over all polygons, that the draws may miss because the sets are very
/// small.
constexpr double kMissingPart = 0.005;

struct Totals {
  int grasps = 0;
  int too_close = 0;
  int vertices = 0;
  int switches = 0;
  int missing = 0;
};

std::int64_t SwitchCount(const PolygonGraph& graph) {
  std::int64_t twice = 0;
  std::vector<int> neighbours;
  for (int v = 0; v < graph.vertex_count(); ++v) {
    graph.GetNeighbours(v, neighbours);
    twice += static_cast<std::int64_t>(neighbours.size());
  }
  return twice / 2;
}

BruteForce Search(const object::Polygon& polygon, const PolygonGraph& graph, double degrees,
                  planning::Spanning spanning) {
  BruteForce brute(polygon, graph, Radians(degrees), spanning, kSeed);
  brute.DrawGrasps(kPairs, kThirds);
  brute.DrawFocusPoints(kPoints);
  brute.CompareTwoFingerSwitches();
  brute.SearchMissing(kSearch, kThirds);
  brute.CompareTwoFingerSwitches();
  return brute;
}

TEST(BruteForce, EveryGraspIsInOneVertexEveryVertexIsHitAndSwitchesAreThoseOfTheGraph) {
  Totals totals;
  for (const auto& [name, polygon] : SmallPolygons()) {
    for (const double degrees : {10.0, 20.0, 35.0, 50.0}) {
      for (const planning::Spanning spanning : kSpannings) {
        SCOPED_TRACE(name + " " + std::to_string(degrees) + " " + Name(spanning));
        const PolygonGraph graph = MakeGraph(polygon, degrees, spanning);
        const BruteForce brute = Search(polygon, graph, degrees, spanning);
        for (const std::string& failure : brute.failures) ADD_FAILURE() << failure;
        EXPECT_EQ(std::count(brute.hits.begin(), brute.hits.end(), 0), 0);
        totals.grasps += brute.grasps;
        totals.too_close += brute.too_close;
        totals.vertices += graph.vertex_count();
        totals.switches += static_cast<int>(brute.switches.size());
        totals.missing +=
            static_cast<int>(SwitchCount(graph)) - static_cast<int>(brute.switches.size());
      }
    }
  }
  EXPECT_GT(totals.grasps, 1000000);
  EXPECT_LT(totals.too_close, totals.grasps / 10000);
  EXPECT_GT(totals.vertices, 1000);
  EXPECT_GT(totals.switches, 10000);
  EXPECT_LT(totals.missing, kMissingPart * totals.switches);
}

TEST(BruteForce, NoticesAGraphOfLessFrictionOfAnotherSpanningAndOfAnotherPolygon) {
  const object::Polygon& blob = SmallPolygons()[4].polygon;
  const auto fails = [&](const PolygonGraph& graph, double degrees, planning::Spanning spanning) {
    return !Search(blob, graph, degrees, spanning).failures.empty();
  };
  EXPECT_FALSE(
      fails(MakeGraph(blob, 20, planning::Spanning::kUniform), 20, planning::Spanning::kUniform));
  EXPECT_TRUE(
      fails(MakeGraph(blob, 15, planning::Spanning::kUniform), 20, planning::Spanning::kUniform));
  EXPECT_TRUE(
      fails(MakeGraph(blob, 20, planning::Spanning::kUniform), 20, planning::Spanning::kAdaptive));
  Ring ring = blob.rings()[0];
  ring[6] = {2.1, 3.1};
  const object::Polygon other = object::Polygon::FromRings({ring}, "other");
  EXPECT_TRUE(
      fails(MakeGraph(other, 20, planning::Spanning::kUniform), 20, planning::Spanning::kUniform));
}

}  // namespace brute_force_test
}  // namespace regrasp::polygon
