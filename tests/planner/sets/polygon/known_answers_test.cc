// Polygons whose switching graphs are counted by hand.

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

/// An equilateral triangle: −√3 is rounded, nothing below depends on it.
object::Polygon EquilateralTriangle() {
  return object::Polygon::FromRings({{{-1, 0}, {1, 0}, {0, std::sqrt(3)}}}, "triangle");
}

/// A regular hexagon of side 1, its opposite edges exactly parallel; the first edge at the bottom.
object::Polygon Hexagon() {
  const double h = std::sqrt(3) / 2;
  return object::Polygon::FromRings({{{-0.5, -h}, {0.5, -h}, {1, 0}, {0.5, h}, {-0.5, h}, {-1, 0}}},
                                    "hexagon");
}

// Square. Of any three normals two are opposite, so none span (a gap of π, and less is needed).
// Up to 45° only opposite sides squeeze, and no three normals are within 2θ up to sign: two sets,
// one switch.
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

// Above 45° neighbouring sides squeeze across their corner too: all 6 pairs. A triple of sides has
// two that face each other; either is a centre for the other two, whose normals are 90° apart
// (the side between them is none: the others' normals are 180° apart). Both centres' sets hold
// grasps with the contact between in the middle and the others at the far end, so they are one:
// 4 triples, 4 vertices. Every contact is valid in each set, and every two contacts of a parallel
// grasp, so all that share an edge (2-finger with parallel: 6 · 4, as a pair always meets a triple)
// or two edges (parallel: 4 · 3 / 2) are joined.
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

// Equilateral triangle. Gaps of 120° θ-positively span for θ < 30°; the centre sees all sides; what
// is behind one side is joined through that side, and behind two sides nothing sees both. Normals
// are 60° from opposite, so pairs need θ > 30°, and 120° from parallel, so triples θ > 60°.
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

// Above 30° two sides squeeze across their corner. Adaptively the concurrent set remains, at 30°;
// every contact is valid in all sets and every pair is two of the three sides.
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

// Regular hexagon, sides 0 to 5. Only {0, 2, 4} and {1, 3, 5} span, with gaps of 120°; the centre
// sees each. They share no side. Below 30° only opposite sides squeeze, and each of these 3 pairs
// shares one side, its middle for one, with either triple.
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

// Between 30° and 60°: the 6 pairs {i, i+2} squeeze as well, 9 in all. Parallel grasps need −n of
// the centre and the other two normals within 60°: {i, i+1, i+3} and {i, i+1, i+4}, centre last,
// 12 in all.
// Just above 30° the forces of {i, i+1, i+3} go along one direction, 120° for i = 0; across it the
// three sides reach over [−1, 0], [0, 1] and [0, 1], and the centre's contact is between the other
// two: all contacts of i, of i+1 and of i+3 are valid, all pairs of (i, i+1) and of (i, i+3), and
// of (i+1, i+3) those with u + u' > 1 (and a little more, as the direction has some play). For {i,
// i+1, i+4} it is the mirror image: u + u' < 1 (and a little more) for (i, i+4).
// - parallel–parallel: (i, i+1) is in 2 triples: 6 · 1; (i, i+3) in 4: 3 · 6; (i, i+2) in 2, which
//   overlap by what is a little more: 6 · 1; 30 together.
// - 2-finger–parallel: of the 9 pairs all but 2 share a side with a triple ({0, 1, 3} misses {2, 4}
//   and {2, 5}): 12 · 7.
// - adaptive, the concurrent sets at 30°: each shares a side with the 3 opposite pairs and with the
// 3
//   pairs of its own sides: 12. Each parallel triple has two sides in common with one of them; it
//   is symmetric in u + u' = 1, so it overlaps on either side: 12.
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

// A bar of 20 by 1. At 10° contacts on its long sides squeeze when less than tan 10° apart along
// it, and those on its short sides always. At 46° the long sides do over a wider stretch; still the
// square's counts, since corners look alike.
TEST(KnownAnswers, ABarIsCountedLikeASquare) {
  const object::Polygon bar =
      object::Polygon::FromRings({{{0, 0}, {20, 0}, {20, 1}, {0, 1}}}, "bar");
  Answer answer;
  answer.two_finger = {2, 2, 2, 1};
  answer.ff = 1;
  answer.components = 1;
  ExpectAnswer(bar, 10, planning::Spanning::kAdaptive, answer);
}

// A slot between two prongs: sides that face away from each other are stretched. At 10° the 4
// upright sides give the pairs of opposite normals: outer with outer and each prong's own two sides
// squeeze, the slot's two sides stretch, and the slot's floor and the prongs' ends squeeze with the
// bottom.
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
  // The right outer side and the slot's left one have the same normal.
  EXPECT_TRUE(graph.SetsOn(Edges({1, 5})).empty());
}

}  // namespace known_answers_test
}  // namespace regrasp::polygon
