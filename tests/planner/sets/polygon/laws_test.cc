// Laws of the switching graph: invariants and monotonicity.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace laws_test {

constexpr GraspType kTypes[] = {GraspType::kConcurrent, GraspType::kTwoFinger,
                                GraspType::kParallel};

std::vector<std::int64_t> AllCounts(const PolygonGraph& graph) {
  std::vector<std::int64_t> all;
  for (const GraspType a : kTypes) {
    const GraspTypeCounts& counts = graph.counts(a);
    all.insert(all.end(),
               {counts.candidates, counts.combinations, counts.vertices, counts.components});
    for (const GraspType b : kTypes) all.push_back(graph.edge_count(a, b));
  }
  all.push_back(graph.components().count());
  return all;
}

object::Polygon Map(const object::Polygon& polygon,
                    const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& f,
                    bool mirrored = false, int first = 0) {
  std::vector<Ring> rings = polygon.rings();
  for (Ring& ring : rings) {
    for (Eigen::Vector2d& p : ring) p = f(p);
    if (mirrored) std::reverse(ring.begin(), ring.end());
    std::rotate(ring.begin(), ring.begin() + first, ring.end());
  }
  return object::Polygon::FromRings(rings, "mapped");
}

TEST(GraphLaws, CountsAreTheSameScaledMirroredTurnedAndRenumbered) {
  using V = Eigen::Vector2d;
  int changed_by_friction = 0;
  for (const auto& [name, polygon] : SmallPolygons()) {
    const std::vector<object::Polygon> same = {
        Map(polygon, [](const V& p) { return V(0x1p-7 * p); }),
        Map(polygon, [](const V& p) { return V(0x1p20 * p); }),
        Map(
            polygon, [](const V& p) { return V(-p.x(), p.y()); }, true),
        Map(polygon, [](const V& p) { return V(-p.y(), p.x()); }),
        Map(
            polygon, [](const V& p) { return p; }, false, 2),
    };
    for (const double degrees : {10.0, 35.0, 50.0}) {
      for (const planning::Spanning spanning : kSpannings) {
        const auto expected = AllCounts(MakeGraph(polygon, degrees, spanning));
        for (const object::Polygon& other : same) {
          EXPECT_EQ(AllCounts(MakeGraph(other, degrees, spanning)), expected)
              << name << " " << degrees << "° " << Name(spanning);
        }
        changed_by_friction += AllCounts(MakeGraph(polygon, degrees / 2, spanning)) != expected;
      }
    }
  }
  EXPECT_GT(changed_by_friction, 20);
}

// A part of a set at less friction is inside a part of a set at more friction.
TEST(GraphLaws, NothingIsLostWhenFrictionGrowsUnderAdaptiveSpanning) {
  int checked = 0;
  int lost_by_uniform = 0;
  for (const auto& [name, polygon] : SmallPolygons()) {
    for (const planning::Spanning spanning : kSpannings) {
      for (const double degrees : {5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0}) {
        const PolygonGraph less = MakeGraph(polygon, degrees, spanning);
        const PolygonGraph more = MakeGraph(polygon, degrees + 7, spanning);
        for (const GraspSet& set : less.sets()) {
          for (const int part : set.parts) {
            const std::vector<sets::SetIndex> there = more.SetsOn(set.edges);
            const bool kept = std::any_of(there.begin(), there.end(), [&](sets::SetIndex v) {
              const GraspSet& other = more.sets()[v];
              return other.type == set.type &&
                     std::count(other.parts.begin(), other.parts.end(), part) == 1;
            });
            if (spanning == planning::Spanning::kAdaptive) {
              EXPECT_TRUE(kept) << name << " " << degrees << "°";
              ++checked;
            } else if (!kept) {
              ++lost_by_uniform;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 1000);
  EXPECT_GT(lost_by_uniform, 10);
}

}  // namespace laws_test
}  // namespace regrasp::polygon
