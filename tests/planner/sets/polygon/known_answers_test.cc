// Polygons with switching graphs that are counted by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace known_answers_test {

constexpr GraspType kC = GraspType::kConcurrent;
constexpr GraspType kF = GraspType::kTwoFinger;
constexpr GraspType kP = GraspType::kParallel;

/// Candidates, combinations, vertices, components.
using Counts = std::array<int, 4>;

struct Answer {
  Counts concurrent{};
  Counts two_finger{};
  Counts parallel{};
  int cc = 0, fc = 0, pp = 0, fp = 0, ff = 0, cp = 0;  ///< switches, by the initials of two types
  int components = 0;
};

void ExpectCounts(const PolygonGraph& graph, GraspType type, const Counts& expected) {
  const GraspTypeCounts& counts = graph.counts(type);
  const Counts found{static_cast<int>(counts.candidates), static_cast<int>(counts.combinations),
                     static_cast<int>(counts.vertices), static_cast<int>(counts.components)};
  EXPECT_EQ(found, expected) << "type " << static_cast<int>(type);
}

void ExpectAnswer(const object::Polygon& polygon, double degrees, planning::Spanning spanning,
                  const Answer& expected) {
  SCOPED_TRACE(std::to_string(degrees) + "° " + Name(spanning));
  const PolygonGraph graph = MakeGraph(polygon, degrees, spanning);
  ExpectCounts(graph, kC, expected.concurrent);
  ExpectCounts(graph, kF, expected.two_finger);
  ExpectCounts(graph, kP, expected.parallel);
  EXPECT_EQ(graph.edge_count(kC, kC), expected.cc);
  EXPECT_EQ(graph.edge_count(kC, kF), expected.fc);
  EXPECT_EQ(graph.edge_count(kP, kP), expected.pp);
  EXPECT_EQ(graph.edge_count(kF, kP), expected.fp);
  EXPECT_EQ(graph.edge_count(kF, kF), expected.ff);
  EXPECT_EQ(graph.edge_count(kC, kP), expected.cp);
  EXPECT_EQ(graph.components().count(), expected.components);
}

/// Make an equilateral triangle. −√3 is rounded, but no answer depends on it.
object::Polygon EquilateralTriangle() {
  return object::Polygon::FromRings({{{-1, 0}, {1, 0}, {0, std::sqrt(3)}}}, "triangle");
}

/// Make a regular hexagon of side 1 with exactly parallel opposite edges; the first edge is at the
/// bottom.
object::Polygon Hexagon() {
  const double h = std::sqrt(3) / 2;
  return object::Polygon::FromRings({{{-0.5, -h}, {0.5, -h}, {1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}}},
                                    "hexagon");
}

// Square. Two of any three normals are opposite, so none span: their gap is π, and it must be
// smaller. Up to 45° only opposite sides form pairs, and no three normals are within 2θ up to sign.
// The graph has two sets and one switch.
TEST(KnownAnswers, ASquareBelow45DegreesHasTwoOpposedGrasps) {
  Answer answer;
  answer.two_finger = {2, 2, 2, 1};
  answer.ff = 1;
  answer.components = 1;
  for (const double degrees : {1.0, 10.0, 20.0, 44.0, 44.999}) {
    for (const planning::Spanning spanning : kSpannings) {
      ExpectAnswer(Square(1), degrees, spanning, answer);
    }
  }
}

// Above 45° adjacent sides form pairs across their corner, too: all 6 pairs. A triple of sides has
// two that face each other. Either is a centre for the two others, whose normals differ by 90°. The
// side between them is not a centre, because the two others' normals differ by 180°. The sets of
// both centres contain grasps with the contact between in the middle and the other contacts at the
// far end. They are therefore one set: 4 triples, 4 vertices. Every contact is valid in each set,
// and so are every two contacts of a parallel grasp. All sets that share an edge are connected
// (2-finger with parallel: 6 · 4, because a pair always shares an edge with a triple), and so are
// those that share two edges (parallel: 4 · 3 / 2).
TEST(KnownAnswers, ASquareAbove45DegreesIsHeldAcrossItsCornersToo) {
  Answer answer;
  answer.two_finger = {6, 6, 6, 1};
  answer.parallel = {4, 4, 4, 1};
  answer.ff = 15;
  answer.pp = 6;
  answer.fp = 24;
  answer.components = 1;
  for (const double degrees : {45.001, 46.0, 60.0, 80.0}) {
    for (const planning::Spanning spanning : kSpannings) {
      ExpectAnswer(Square(1), degrees, spanning, answer);
    }
  }
}

// Equilateral triangle. Gaps of 120° θ-positively span for θ < 30°. The centre sees all sides. The
// region behind one side is connected through that side, and no point behind two sides sees both.
// Normals differ by 60° from opposite, so pairs need θ > 30°. They differ by 120° from parallel, so
// triples need θ > 60°.
TEST(KnownAnswers, AnEquilateralTriangleBelow30DegreesHasOneConcurrentSet) {
  Answer answer;
  answer.concurrent = {1, 1, 1, 1};
  answer.components = 1;
  for (const double degrees : {5.0, 25.0, 29.9}) {
    for (const planning::Spanning spanning : kSpannings) {
      ExpectAnswer(EquilateralTriangle(), degrees, spanning, answer);
      const PolygonGraph graph = MakeGraph(EquilateralTriangle(), degrees, spanning);
      EXPECT_EQ(graph.sets()[0].parts, (std::vector<int>{0, 1, 2, 4}));
    }
  }
}

// Above 30° two sides form a pair across their corner. With `adaptive` the concurrent set remains,
// at 30°. Every contact is valid in all sets, and every pair consists of two of the three sides.
TEST(KnownAnswers, AnEquilateralTriangleAbove30DegreesIsSqueezedAcrossItsCorners) {
  Answer answer;
  answer.two_finger = {3, 3, 3, 1};
  answer.ff = 3;
  answer.components = 1;
  for (const double degrees : {30.1, 31.0, 59.0}) {
    ExpectAnswer(EquilateralTriangle(), degrees, planning::Spanning::kUniform, answer);
  }
  answer.concurrent = {1, 1, 1, 1};
  answer.fc = 3;
  for (const double degrees : {30.1, 31.0, 59.0}) {
    ExpectAnswer(EquilateralTriangle(), degrees, planning::Spanning::kAdaptive, answer);
  }
}

// Regular hexagon, sides 0 to 5. Only {0, 2, 4} and {1, 3, 5} span, with gaps of 120°. The centre
// sees each side of them, and they share no side. Below 30° only opposite sides form pairs. Each of
// these 3 pairs shares one side, with a common contact in its middle, with either triple.
TEST(KnownAnswers, AHexagonBelow30DegreesHasTwoTriplesAndThreePairs) {
  Answer answer;
  answer.concurrent = {2, 2, 2, 2};
  answer.two_finger = {3, 3, 3, 1};
  answer.fc = 6;
  answer.ff = 3;
  answer.components = 1;
  for (const double degrees : {5.0, 10.0, 20.0, 29.9}) {
    for (const planning::Spanning spanning : kSpannings) {
      ExpectAnswer(Hexagon(), degrees, spanning, answer);
    }
  }
}

// Between 30° and 60° the 6 pairs {i, i+2} are grasps as well, so there are 9 pairs. Parallel
// grasps need −n of the centre and the two other normals within 60°: {i, i+1, i+3} and {i, i+1,
// i+4}, centre last, 12 in all. Just above 30° the forces of {i, i+1, i+3} have one direction, 120°
// for i = 0. Across it the three sides extend over [−1, 0], [0, 1] and [0, 1], and the centre's
// contact is between the two others. All contacts of i, i+1 and i+3 are therefore valid, and all
// pairs of (i, i+1) and of (i, i+3). The valid pairs of (i+1, i+3) have u + u' > 1, and slightly
// less because the direction is not unique. For {i, i+1, i+4}, the mirror image, the pairs of (i,
// i+4) have u + u' < 1, and slightly more.
// - parallel–parallel: (i, i+1) is in 2 triples: 6 · 1. (i, i+3) is in 4: 3 · 6. (i, i+2) is in 2,
//   which overlap slightly around u + u' = 1: 6 · 1. The sum is 30.
// - 2-finger–parallel: each triple shares a side with all of the 9 pairs except 2 ({0, 1, 3} with
//   {2, 4} and {2, 5}): 12 · 7.
// - With `adaptive`, the concurrent sets at 30°: each shares a side with the 3 opposite pairs and
//   with the 3 pairs of its own sides: 12. Each parallel triple has two common sides with one of
//   them. That set is symmetric in u + u' = 1, so it overlaps on either side: 12.
TEST(KnownAnswers, AHexagonAbove30DegreesHasTwelveParallelSets) {
  Answer answer;
  answer.two_finger = {9, 9, 9, 1};
  answer.parallel = {12, 12, 12, 1};
  answer.ff = 36;
  answer.pp = 30;
  answer.fp = 84;
  answer.components = 1;
  for (const double degrees : {30.1, 31.0, 45.0, 59.0}) {
    ExpectAnswer(Hexagon(), degrees, planning::Spanning::kUniform, answer);
  }
  answer.concurrent = {2, 2, 2, 2};
  answer.fc = 12;
  answer.cp = 12;
  for (const double degrees : {30.1, 31.0, 45.0, 59.0}) {
    ExpectAnswer(Hexagon(), degrees, planning::Spanning::kAdaptive, answer);
  }
}

// A bar of 20 by 1. At 10°, contacts on its long sides form a pair if they are less than tan 10°
// apart along it; contacts on its short sides always do. At 46° the range on the long sides is
// larger. The counts are still those of the square, because the corners are the same.
TEST(KnownAnswers, ABarIsCountedLikeASquare) {
  const object::Polygon bar =
      object::Polygon::FromRings({{{0, 0}, {20, 0}, {20, 1}, {0, 1}}}, "bar");
  Answer answer;
  answer.two_finger = {2, 2, 2, 1};
  answer.ff = 1;
  answer.components = 1;
  ExpectAnswer(bar, 10, planning::Spanning::kAdaptive, answer);
}

// A slot between two prongs; sides that face away from each other permit stretching grasps. At 10°
// the 4 upright sides form pairs of opposite normals. Grasps from outside are on the two outer
// sides and on the two sides of each prong. The two sides of the slot permit stretching. The floor
// of the slot and the ends of the prongs form pairs with the bottom.
TEST(KnownAnswers, AForkIsSqueezedAndStretched) {
  const object::Polygon fork = object::Polygon::FromRings(
      {{{0, 0}, {3, 0}, {3, 4}, {2, 4}, {2, 1}, {1, 1}, {1, 4}, {0, 4}}}, "fork");
  const PolygonGraph graph = MakeGraph(fork, 10, planning::Spanning::kUniform);
  const auto parts = [&](int a, int b) {
    std::vector<int> found;
    for (const sets::SetIndex v : graph.SetsOn(Edges({a, b}))) {
      for (const int part : graph.sets()[v].parts) found.push_back(part);
    }
    return found;
  };
  EXPECT_EQ(parts(1, 7), std::vector<int>{0});  // outer sides
  EXPECT_EQ(parts(1, 3), std::vector<int>{0});  // right prong
  EXPECT_EQ(parts(5, 7), std::vector<int>{0});  // left prong
  EXPECT_EQ(parts(3, 5), std::vector<int>{1});  // slot
  EXPECT_EQ(parts(0, 2), std::vector<int>{0});
  EXPECT_EQ(parts(0, 4), std::vector<int>{0});
  EXPECT_EQ(parts(0, 6), std::vector<int>{0});
  EXPECT_EQ(graph.counts(kF).vertices, 7);
  // The right outer side and the left side of the slot have the same normal.
  EXPECT_TRUE(graph.SetsOn(Edges({1, 5})).empty());
}

}  // namespace known_answers_test
}  // namespace regrasp::polygon
