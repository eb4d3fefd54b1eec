#include <gtest/gtest.h>

#include <cmath>

#include "planner/sets/contour/grasp_pieces.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/sets/contour/outlines.h"

namespace regrasp::contour {
namespace deadline_test {

TEST(ContourDeadline, TheGraphLooksAtItForEveryPieceAndEndsWhereverItComes) {
  const object::Polygon polygon = IrregularOutline(40, 0.8, 3);
  const CountedDeadline never;
  const ContourGraph graph(polygon, Radians(20), never.deadline());
  EXPECT_GE(never.looks(), graph.candidate_count() + std::ssize(graph.pieces()));
  ExpectEndsWhereverItComes(never.looks(), [&](const Deadline& deadline) {
    static_cast<void>(ContourGraph(polygon, Radians(20), deadline));
  });
}

TEST(ContourDeadline, EveryStageOfTheGraphLooksAtItForEachThingThatItGoesThrough) {
  const object::Polygon polygon = IrregularOutline(40, 0.8, 3);
  const double tangent = std::tan(Radians(20));
  const polygon::IntervalScope scope;
  const polygon::EdgeTable edges(polygon, tangent);
  const Boundary boundary(polygon);
  const CountedDeadline of_candidates, of_pieces, of_passages, of_overlaps;
  const auto candidates = polygon::FindTwoFingerCandidates(edges, of_candidates.deadline());
  EXPECT_EQ(of_candidates.looks(), 2 * edges.size());  // once by angle and once in order
  const auto pieces = FindPieces(edges, candidates, of_pieces.deadline());
  EXPECT_EQ(of_pieces.looks(), std::ssize(candidates));
  static_cast<void>(FindPassages(edges, boundary, pieces, of_passages.deadline()));
  EXPECT_EQ(of_passages.looks(), std::ssize(pieces));
  const int count = static_cast<int>(pieces.size());
  std::vector<PieceIndex> numbers(pieces.size());
  for (PieceIndex i{0}; i < count; ++i) numbers[i] = i;
  const auto one_by_one = [&](sets::SetIndex set) {
    return std::span<const PieceIndex>(&numbers[set], 1);
  };
  static_cast<void>(
      FindOverlaps(edges, boundary, pieces, count, one_by_one, of_overlaps.deadline()));
  // Each piece projects onto both of its edges, and each projection has two ends.
  EXPECT_EQ(of_overlaps.looks(), 5 * count);
}

}  // namespace deadline_test
}  // namespace regrasp::contour
