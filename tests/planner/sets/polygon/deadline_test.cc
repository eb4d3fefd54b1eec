#include <gtest/gtest.h>

#include <cmath>

#include "planner/sets/polygon/candidates.h"
#include "planner/sets/polygon/polygon_graph.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/sets/polygon/shapes.h"

namespace regrasp::polygon {
namespace deadline_test {

/// Return the number of deadline checks for listing the candidates of all types.
int LooksForCandidates(const object::Polygon& polygon, double friction_angle) {
  const double tangent = std::tan(friction_angle);
  const IntervalScope scope;
  const EdgeTable edges(polygon, tangent);
  const CountedDeadline never;
  static_cast<void>(
      FindConcurrentCandidates(edges, planning::Spanning::kAdaptive, never.deadline()));
  static_cast<void>(FindTwoFingerCandidates(edges, never.deadline()));
  static_cast<void>(FindParallelCandidates(edges, never.deadline()));
  return never.looks();
}

TEST(PolygonDeadline, TheGraphLooksAtItForEveryCandidateAndVertexAndEndsWhereverItComes) {
  const object::Polygon polygon = RegularPolygon(9);
  const CountedDeadline never;
  const PolygonGraph graph(polygon, Radians(20), planning::Spanning::kAdaptive, never.deadline());
  const GraspTypeCounts& concurrent = graph.counts(GraspType::kConcurrent);
  const GraspTypeCounts& two_finger = graph.counts(GraspType::kTwoFinger);
  const GraspTypeCounts& parallel = graph.counts(GraspType::kParallel);
  ASSERT_TRUE(concurrent.vertices > 0 && two_finger.vertices > 0 && parallel.vertices > 0);
  const int listing = LooksForCandidates(polygon, Radians(20));
  EXPECT_GE(listing, 9 + 2 * 9 + 9);
  const auto candidates = concurrent.candidates + two_finger.candidates + parallel.candidates;
  // Checks happen when vertices are listed, joined on each of their three pairs of edges or as
  // 2-finger vertices, and when concurrent and parallel ones on the same edges are joined.
  const auto joining = 3 * (concurrent.vertices + parallel.vertices) + two_finger.vertices;
  EXPECT_EQ(never.looks(),
            listing + candidates + graph.vertex_count() + joining + concurrent.vertices);
  ExpectEndsWhereverItComes(never.looks(), [&](const Deadline& deadline) {
    static_cast<void>(PolygonGraph(polygon, Radians(20), planning::Spanning::kAdaptive, deadline));
  });
}

}  // namespace deadline_test
}  // namespace regrasp::polygon
