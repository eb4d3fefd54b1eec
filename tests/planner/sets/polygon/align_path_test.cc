#include <gtest/gtest.h>

#include <array>

#include "planner/motion/path_force_closure.h"
#include "planner/sets/polygon/graph_cells.h"
#include "planner/sets/polygon/polygon_planner.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace align_path_test {

grasp::Grasp GraspAt(const object::Polygon& polygon, const GraspSet& set,
                     const Eigen::VectorXd& parameters) {
  grasp::Grasp grasp;
  for (const FaceIndex edge : set.edges) {
    grasp.push_back(grasp::ContactAt(polygon, edge, parameters[static_cast<int>(grasp.size())]));
  }
  return grasp;
}

Eigen::VectorXd ParametersOf(const object::Polygon& polygon, const grasp::Grasp& grasp) {
  Eigen::VectorXd parameters(static_cast<Eigen::Index>(grasp.size()));
  for (std::size_t k = 0; k < grasp.size(); ++k) {
    parameters[static_cast<Eigen::Index>(k)] = grasp::ParameterOf(polygon, grasp[k]);
  }
  return parameters;
}

/// Decided by the certificates of the checker, which do not use grasp sets.
bool IsForceClosureBetween(const object::Polygon& polygon, const grasp::Grasp& from,
                           const grasp::Grasp& to, double friction_angle) {
  motion::GraspMotion motion;
  for (std::size_t k = 0; k < from.size(); ++k) motion.emplace_back(from[k], to[k]);
  return motion::DecidePathForceClosure(motion, polygon.wrench_frame(), friction_angle).holds();
}

struct AlignCount {
  std::array<int, kGraspTypes> direct{};
  std::array<int, kGraspTypes> by_passages{};
  int lost_at_half_the_friction = 0;
};

/// Check sliding steps between two random grasps of every set.
void CheckAligns(const object::Polygon& polygon, double degrees, std::uint64_t seed,
                 AlignCount& count) {
  const PolygonGraph graph = MakeGraph(polygon, degrees, planning::Spanning::kAdaptive);
  GraphCells cells(polygon, graph);
  RandomStream random(seed, RandomUse::kStart);
  for (sets::SetIndex vertex{0}; vertex < graph.vertex_count(); ++vertex) {
    const GraspSet& set = graph.sets()[vertex];
    const grasp::Grasp from = cells.GraspOf(*cells.Draw(vertex, random));
    const grasp::Grasp to = cells.GraspOf(*cells.Draw(vertex, random));
    ASSERT_EQ(from.size(), set.edges.size());
    const std::vector<Eigen::VectorXd> path =
        FindAlignPath(cells.of(vertex), ParametersOf(polygon, from), ParametersOf(polygon, to));
    ASSERT_GE(path.size(), 2U) << "vertex " << vertex;
    EXPECT_EQ(path.front(), ParametersOf(polygon, from));
    EXPECT_EQ(path.back(), ParametersOf(polygon, to));
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      EXPECT_TRUE(IsForceClosureBetween(polygon, GraspAt(polygon, set, path[i]),
                                        GraspAt(polygon, set, path[i + 1]), Radians(degrees)))
          << "vertex " << vertex << ", segment " << i;
    }
    ++(path.size() == 2 ? count.direct : count.by_passages)[static_cast<int>(set.type)];
    if (!IsForceClosureBetween(polygon, from, to, Radians(degrees / 2))) {
      ++count.lost_at_half_the_friction;
    }
  }
}

TEST(AlignPath, KeepsForceClosureBetweenRandomGraspsOfASet) {
  AlignCount count;
  for (const auto& [name, polygon] : SmallPolygons()) {
    SCOPED_TRACE(name);
    for (const double degrees : {10.0, 20.0, 40.0, 50.0}) CheckAligns(polygon, degrees, 1, count);
  }
  for (const int direct : count.direct) EXPECT_GT(direct, 50);
  EXPECT_GT(count.by_passages[static_cast<int>(GraspType::kConcurrent)], 10);
  EXPECT_GT(count.by_passages[static_cast<int>(GraspType::kParallel)], 10);
  EXPECT_GT(count.lost_at_half_the_friction, 100);
}

TEST(AlignPath, LeadsNowhereFromAGraspOutsideTheSet) {
  const object::Polygon square = Square(1);
  const PolygonGraph graph = MakeGraph(square, 20, planning::Spanning::kAdaptive);
  const GraspSet& set = graph.sets()[graph.SetsOn(Edges({0, 2})).front()];
  const SetCells cells(square, set);
  // Edge 2 is directed from right to left.
  const Eigen::Vector2d upright(0.5, 0.5);
  const Eigen::Vector2d leaning(0.9, 0.9);
  EXPECT_EQ(FindAlignPath(cells, upright, Eigen::Vector2d(0.25, 0.75)).size(), 2U);
  EXPECT_TRUE(FindAlignPath(cells, upright, leaning).empty());
  EXPECT_TRUE(FindAlignPath(cells, leaning, upright).empty());
}

}  // namespace align_path_test
}  // namespace regrasp::polygon
