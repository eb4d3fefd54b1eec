#include <gtest/gtest.h>

#include <cmath>

#include "planner/sets/polyhedron/normal_quadruples.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace {

TEST(PolyhedronDeadline, TheGraphLooksAtItForEveryCandidateAndCellAndEndsWhereverItComes) {
  const object::Polyhedron body = RegularOctahedron();
  const CountedDeadline never;
  const PolyhedronGraph graph(body, Radians(15), planning::Spanning::kAdaptive, never.deadline());
  ASSERT_GT(graph.vertex_count(), 0);
  const CountedDeadline listing;
  static_cast<void>(FindQuadrupleCandidates(body, std::tan(Radians(15)),
                                            planning::Spanning::kAdaptive, listing.deadline()));
  EXPECT_EQ(listing.looks(), 2 * (8 * 7 / 2));  // each pair of faces twice
  // Cells are joined on each of their four triples of faces.
  EXPECT_EQ(never.looks(), listing.looks() + graph.candidate_count() + 4 * graph.vertex_count());
  ExpectEndsWhereverItComes(never.looks(), [&](const Deadline& deadline) {
    static_cast<void>(PolyhedronGraph(body, Radians(15), planning::Spanning::kAdaptive, deadline));
  });
}

}  // namespace
}  // namespace regrasp::polyhedron
