// Sets that touch exactly, in coordinates and tangents that are exact doubles, do not meet. If they
// are slightly closer, they meet; if they are slightly farther apart, they do not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/planner/sets/polygon/graph_oracle.h"
#include "tests/planner/sets/polygon/shapes.h"
#include "tests/planner/sets/polygon/two_finger_oracle.h"

namespace regrasp::polygon {
namespace touching_test {

constexpr double kTangent = 0.25;

/// Return the angle whose tangent is exactly this double.
double FrictionAngle() {
  double angle = std::atan(kTangent);
  while (std::tan(angle) > kTangent) angle = std::nextafter(angle, 0);
  while (std::tan(angle) < kTangent) angle = std::nextafter(angle, 1);
  return angle;
}

/// Return the only vertex of a type on these edges; −1 if there is none.
int VertexOn(const PolygonGraph& graph, GraspType type, const std::vector<int>& edges) {
  int found = -1;
  for (const sets::SetIndex v : graph.SetsOn(Edges(edges))) {
    if (graph.sets()[v].type != type) continue;
    EXPECT_EQ(found, -1);
    found = v;
  }
  return found;
}

bool Joined(const PolygonGraph& graph, int a, int b) {
  std::vector<int> neighbours;
  graph.GetNeighbours(a, neighbours);
  return std::count(neighbours.begin(), neighbours.end(), b) > 0;
}

/// Check that both oracles agree with the graph.
void ExpectOraclesAgree(const object::Polygon& polygon, const PolygonGraph& graph,
                        planning::Spanning spanning) {
  std::string difference;
  EXPECT_GT(CompareWithSetOperations(polygon, graph, FrictionAngle(), spanning, difference).cells,
            0);
  EXPECT_EQ(difference, "");
  EXPECT_GT(CompareTwoFingerSets(polygon, graph, FrictionAngle(), difference).candidates, 0);
  EXPECT_EQ(difference, "");
}

/// Distance of the moved part from touching; negative beyond it.
constexpr double kApart[] = {0.25, 1e-6, 1e-12, 0x1p-51, 0, -0x1p-51, -1e-12, -1e-6, -0.25};

// A house with two feet, [0, 1] and [2, 3] on y = 0. The regions that see them are |x − 0.5| < 0.5
// + y/4 and |x − 2.5| < 0.5 + y/4, which meet above (1.5, 2). The region that sees both slopes of
// the roof ends at that point if their upper ends are (4, 3.5) and (−1, 3.5): the upper border of
// the right one starts at its end along (−5, −3). This region ends above y = −2, at which the
// feet's regions meet again.
TEST(Touching, CellsThatTouchInAPointAreNotJoined) {
  constexpr int kLeft = 0;
  constexpr int kRight = 3;
  constexpr int kSlopes[] = {5, 7};
  for (const planning::Spanning spanning : kSpannings) {
    for (const double apart : kApart) {
      SCOPED_TRACE(std::to_string(apart) + " " + Name(spanning));
      const double top = 3.5 - apart;
      const double foot = 3.25 - apart;
      const object::Polygon house = object::Polygon::FromRings({{{0, 0},
                                                                 {1, 0},
                                                                 {1.5, 0.5},
                                                                 {2, 0},
                                                                 {3, 0},
                                                                 {4.25, foot},
                                                                 {4, top},
                                                                 {-1, top},
                                                                 {-1.25, foot}}},
                                                               "house");
      const PolygonGraph graph(house, FrictionAngle(), spanning);
      const int a = VertexOn(graph, GraspType::kConcurrent, {kLeft, kSlopes[0], kSlopes[1]});
      const int b = VertexOn(graph, GraspType::kConcurrent, {kRight, kSlopes[0], kSlopes[1]});
      ASSERT_GE(a, 0);
      ASSERT_GE(b, 0);
      EXPECT_EQ(Joined(graph, a, b), apart < 0);
      ExpectOraclesAgree(house, graph, spanning);
    }
  }
}

// Two edges that turn by exactly twice the friction angle at (1, 0), from (1, 0) to (15, −8), tan =
// 8/15. The right border of the region that sees the first edge, along (1, 4), is the left border
// of the region that sees the second one.
TEST(Touching, CellsThatTouchAlongASegmentAreNotJoined) {
  for (const double apart : kApart) {
    SCOPED_TRACE(apart);
    const object::Polygon polygon = object::Polygon::FromRings(
        {{{0, 0}, {1, 0}, {2.875, -1 - apart}, {4, 0}, {3, 2}, {-0.4, 3.6}, {-0.8, 3.2}}}, "turn");
    const PolygonGraph graph(polygon, FrictionAngle(), planning::Spanning::kUniform);
    const int a = VertexOn(graph, GraspType::kConcurrent, {0, 3, 5});
    const int b = VertexOn(graph, GraspType::kConcurrent, {1, 3, 5});
    ASSERT_GE(a, 0);
    ASSERT_GE(b, 0);
    EXPECT_EQ(Joined(graph, a, b), apart < 0);
    ExpectOraclesAgree(polygon, graph, planning::Spanning::kUniform);
  }
}

// A hall with a floor y = 0 and three pieces of ceiling at y = 2. Parallel grasps with the first
// two, [0, 0.25] and [0.75, 1], and the floor as centre need floor contacts left of 1 + 2/4 = 1.5.
// The third piece begins at 2, so its 2-finger grasps need floor contacts right of 2 − 2/4 = 1.5.
TEST(Touching, ContactsThatTouchDoNotJoinAParallelAndATwoFingerSet) {
  for (const planning::Spanning spanning : kSpannings) {
    for (const double apart : kApart) {
      SCOPED_TRACE(std::to_string(apart) + " " + Name(spanning));
      const object::Polygon hall = object::Polygon::FromRings({{{0, 0},
                                                                {4, 0},
                                                                {4, 2},
                                                                {2 + apart, 2},
                                                                {1.5, 3},
                                                                {1, 2},
                                                                {0.75, 2},
                                                                {0.5, 3},
                                                                {0.25, 2},
                                                                {0, 2}}},
                                                              "hall");
      const PolygonGraph graph(hall, FrictionAngle(), spanning);
      const int parallel = VertexOn(graph, GraspType::kParallel, {0, 5, 8});
      const int grasp_force = VertexOn(graph, GraspType::kTwoFinger, {0, 2});
      ASSERT_GE(parallel, 0);
      ASSERT_GE(grasp_force, 0);
      EXPECT_EQ(Joined(graph, parallel, grasp_force), apart < 0);
      ExpectOraclesAgree(hall, graph, spanning);
    }
  }
}

}  // namespace touching_test
}  // namespace regrasp::polygon
