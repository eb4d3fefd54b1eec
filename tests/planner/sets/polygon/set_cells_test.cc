#include "planner/sets/polygon/set_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/planner/sets/polygon/direct_conditions.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace set_cells_test {

/// Contacts on distinct random edges, sorted by edge.
struct Draw {
  std::vector<int> edges;
  Eigen::VectorXd parameters;
  grasp::Grasp grasp;
};

Draw DrawContacts(const object::Polygon& polygon, int count, std::mt19937_64& engine) {
  std::vector<int> all(polygon.face_count());
  for (FaceIndex e{0}; e < polygon.face_count(); ++e) all[e] = e;
  Draw draw;
  std::sample(all.begin(), all.end(), std::back_inserter(draw.edges), count, engine);
  draw.parameters.resize(count);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < count; ++k) {
    draw.parameters[k] = uniform(engine);
    draw.grasp.push_back(grasp::ContactAt(polygon, FaceIndex(draw.edges[k]), draw.parameters[k]));
  }
  return draw;
}

/// Counts of comparisons between cells and direct conditions.
struct Agreement {
  int inside = 0;
  int outside = 0;
  int too_close = 0;
};

void Compare(const PolygonGraph& graph, const object::Polygon& polygon, const Draw& draw,
             const std::vector<DirectKind>& kinds, Agreement& count) {
  for (const sets::SetIndex vertex : graph.SetsOn(Edges(draw.edges))) {
    const GraspSet& set = graph.sets()[vertex];
    std::vector<DirectKind> fitting = kinds;
    std::erase_if(fitting, [&](const DirectKind& kind) {
      return kind.type != set.type ||
             !std::binary_search(set.parts.begin(), set.parts.end(), kind.part);
    });
    const bool certain = std::any_of(fitting.begin(), fitting.end(),
                                     [](const DirectKind& kind) { return kind.certain; });
    if (!certain && !fitting.empty()) {
      ++count.too_close;
      continue;
    }
    EXPECT_EQ(IsInSet(SetCells(polygon, set), draw.parameters), certain)
        << "vertex " << vertex << " at " << draw.parameters.transpose();
    ++(certain ? count.inside : count.outside);
  }
}

TEST(SetCells, HoldWhatTheDirectConditionsSay) {
  std::mt19937_64 engine(1);
  Agreement count;
  for (const auto& [name, polygon] : SmallPolygons()) {
    for (const double degrees : {10.0, 25.0, 50.0}) {
      for (const planning::Spanning spanning : kSpannings) {
        SCOPED_TRACE(name + " at " + std::to_string(degrees) + "°, " + Name(spanning));
        const PolygonGraph graph = MakeGraph(polygon, degrees, spanning);
        for (int i = 0; i < 300; ++i) {
          const Draw two = DrawContacts(polygon, 2, engine);
          Compare(graph, polygon, two, KindsOfTwo(two.grasp, Radians(degrees)), count);
          const Draw three = DrawContacts(polygon, 3, engine);
          Compare(graph, polygon, three,
                  KindsOfThree(three.grasp, Radians(degrees), spanning, polygon.diameter()), count);
        }
      }
    }
  }
  EXPECT_GT(count.inside, 1000);
  EXPECT_GT(count.outside, 1000);
  EXPECT_LT(count.too_close, 20);
}

TEST(SetCells, EveryPartOfASetHasACellWithSlackAtItsCentre) {
  int cells = 0;
  for (const auto& [name, polygon] : SmallPolygons()) {
    const PolygonGraph graph = MakeGraph(polygon, 50, planning::Spanning::kAdaptive);
    for (const GraspSet& set : graph.sets()) {
      const SetCells of_set(polygon, set);
      const auto contacts = static_cast<Eigen::Index>(set.edges.size());
      std::vector<int> parts;
      for (const GraspCell& cell : of_set.cells()) {
        EXPECT_GT(cell.centre.slack, kNoSlack) << name;
        EXPECT_LE(cell.centre.slack, of_set.width());
        EXPECT_NEAR(SlackInCell(cell, cell.centre.z.head(contacts)), cell.centre.slack, kNoSlack);
        parts.push_back(cell.part);
        ++cells;
      }
      parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
      EXPECT_EQ(parts, set.parts) << name;
    }
  }
  EXPECT_GT(cells, 500);
}

TEST(SetCells, ClearWidthsOfParallelSetsAreNoneOrThoseOfGraspsInThem) {
  int parallel = 0;
  int clear = 0;
  for (const auto& [name, polygon] : SmallPolygons()) {
    const PolygonGraph graph = MakeGraph(polygon, 30, planning::Spanning::kAdaptive);
    for (const GraspSet& set : graph.sets()) {
      if (set.type != GraspType::kParallel) continue;
      const double width = ClearWidth(polygon, set);
      // It has more inequalities than any cell.
      EXPECT_LE(width, SetCells(polygon, set).width() + kNoSlack) << name;
      EXPECT_GE(width, 0);
      ++parallel;
      clear += width > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(parallel, 30);
  EXPECT_GT(clear, 10);
}

TEST(SetCells, MeasureSlackInDiametersAtAnyScale) {
  // 2-finger grasps of the bottom and top of the unit square. The border of a cone of 45° passes
  // the middle of the opposite edge at a distance of 1 / √2, with clearance to the ends of the
  // edges.
  for (const double size : {1.0, 1000.0}) {
    const object::Polygon square = Square(size);
    const PolygonGraph graph = MakeGraph(square, 45, planning::Spanning::kAdaptive);
    const std::vector<sets::SetIndex> vertices = graph.SetsOn(Edges({0, 2}));
    ASSERT_EQ(vertices.size(), 1U);
    const SetCells cells(square, graph.sets()[vertices.front()]);
    ASSERT_EQ(cells.cells().size(), 1U);
    const double to_ends = 0.5 / square.diameter() * size;
    EXPECT_NEAR(cells.width(), to_ends, 1e-12);
    EXPECT_NEAR(SlackInCell(cells.cells().front(), Eigen::Vector2d(0.25, 0.75)), to_ends / 2,
                1e-12);
  }
}

TEST(SetCells, ContactAndParameterAreInverse) {
  const object::Polygon& ring = SmallPolygons().back().polygon;
  for (FaceIndex edge{0}; edge < ring.face_count(); ++edge) {
    const grasp::Contact contact = grasp::ContactAt(ring, FaceIndex(edge), 0.3);
    EXPECT_EQ(contact.face, edge);
    EXPECT_EQ(contact.n, ring.inward_normal(FaceIndex(edge)));
    EXPECT_NEAR(grasp::ParameterOf(ring, contact), 0.3, 1e-15);
    EXPECT_NEAR(ring.DistanceToBorder(FaceIndex(edge), contact.p),
                0.3 * ring.face_measure(FaceIndex(edge)), 1e-12);
  }
}

}  // namespace set_cells_test

namespace slack_program_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Tolerance of slacks of order 1: a few hundred roundings.
constexpr double kTolerance = 1e-13;

/// Return the inequalities low < x < high and low < y < high.
Inequalities Box(double low, double high) {
  Inequalities box;
  box.rows = MatrixXd(4, 2);
  box.rows << 1, 0, -1, 0, 0, 1, 0, -1;
  box.offsets = VectorXd(4);
  box.offsets << -low, high, -low, high;
  return box;
}

TEST(SlackProgram, TheMiddleOfABoxIsFarthestFromItsSides) {
  const SlackSolution solution = MaximizeSlack(Box(0.25, 0.75));
  EXPECT_NEAR(solution.slack, 0.25, kTolerance);
  EXPECT_NEAR((solution.z - Vector2d(0.5, 0.5)).norm(), 0, kTolerance);
}

TEST(SlackProgram, TheIncentreOfATriangleIsFarthestFromItsSides) {
  // x > 0, y > 0 and 3x + 4y < 12: a 3-4-5 triangle with an inscribed circle of radius 1.
  Inequalities triangle;
  triangle.rows = MatrixXd(3, 2);
  triangle.rows << 1, 0, 0, 1, -0.6, -0.8;
  triangle.offsets = VectorXd(3);
  triangle.offsets << 0, 0, 2.4;
  const SlackSolution solution = MaximizeSlack(triangle);
  EXPECT_NEAR(solution.slack, 1, kTolerance);
  EXPECT_NEAR((solution.z - Vector2d(1, 1)).norm(), 0, kTolerance);
}

TEST(SlackProgram, ASetWithoutInteriorHasNoSlackAndAnEmptyOneLess) {
  EXPECT_NEAR(MaximizeSlack(Box(0.5, 0.5)).slack, 0, kTolerance);
  EXPECT_NEAR(MaximizeSlack(Box(0.5, 0.25)).slack, -0.125, kTolerance);
}

TEST(SlackProgram, MoreSlackThanEnoughCountsForNothing) {
  const SlackSolution solution = MaximizeSlack(Box(-100, 100), 3);
  EXPECT_GE(solution.slack, 3 - kTolerance);
  // x > 0 alone is unbounded.
  Inequalities half_line;
  half_line.rows = MatrixXd::Ones(1, 1);
  half_line.offsets = VectorXd::Zero(1);
  EXPECT_GE(MaximizeSlack(half_line).slack, 1 - kTolerance);
}

TEST(SlackProgram, WithoutVariablesTheSlackIsTheSmallestOffset) {
  Inequalities fixed;
  fixed.rows = MatrixXd(3, 0);
  fixed.offsets = VectorXd(3);
  fixed.offsets << 0.5, 0.125, 0.25;
  EXPECT_EQ(MaximizeSlack(fixed).slack, 0.125);
}

TEST(SlackProgram, NoRandomPointHasMoreSlack) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(engine); };
  int nearly_best = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const int rows = 8 + trial % 10;
    const int variables = 1 + trial % 7;
    Inequalities set = {MatrixXd::NullaryExpr(rows, variables, draw),
                        VectorXd::NullaryExpr(rows, draw)};
    const SlackSolution best = MaximizeSlack(set);
    EXPECT_EQ(best.slack, set.SlackAt(best.z));
    if (best.slack >= 1 - kTolerance) continue;  // limited by `enough`
    for (int i = 0; i < 200; ++i) {
      const VectorXd z = best.z + 1e-3 * VectorXd::NullaryExpr(variables, draw);
      EXPECT_LE(set.SlackAt(z), best.slack + kTolerance);
      nearly_best += set.SlackAt(z) > best.slack - 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(nearly_best, 1000);
}

}  // namespace slack_program_test
}  // namespace regrasp::polygon
