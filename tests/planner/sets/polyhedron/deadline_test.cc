#include <gtest/gtest.h>

#include <cmath>

#include "planner/sets/polyhedron/normal_quadruples.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"
#include "tests/fixtures/deadline_laws.h"
#include "tests/planner/sets/polyhedron/bodies.h"

namespace regrasp::polyhedron {
namespace deadline_test {

TEST(PolyhedronDeadline, TheGraphLooksAtItForEveryCandidateAndCellAndEndsWhereverItComes) {
  const object::Polyhedron body = RegularOctahedron();
  const CountedDeadline never;
  const PolyhedronGraph graph(body, Radians(15), planning::Spanning::kAdaptive, never.deadline());
  ASSERT_GT(graph.vertex_count(), 0);
  const CountedDeadline listing;
  static_cast<void>(FindQuadrupleCandidates(body, std::tan(Radians(15)),
                                            planning::Spanning::kAdaptive, listing.deadline()));
  EXPECT_EQ(listing.looks(), 2 * (8 * 7 / 2));  // each pair of faces twice
  // Cells are connected on each of their four triples of faces.
  EXPECT_EQ(never.looks(), listing.looks() + graph.candidate_count() + 4 * graph.vertex_count());
  ExpectEndsWhereverItComes(never.looks(), [&](const Deadline& deadline) {
    static_cast<void>(PolyhedronGraph(body, Radians(15), planning::Spanning::kAdaptive, deadline));
  });
}

TEST(PolyhedronDeadline, SamplingLooksAtItForEveryPointAndEndsWhereverItComes) {
  const object::Polyhedron body = RegularOctahedron();
  PolyhedronGraph graph(body, Radians(15), planning::Spanning::kAdaptive);
  const CountedDeadline bounding;
  const auto region = FindSamplingRegion(body, graph, bounding.deadline());
  EXPECT_EQ(bounding.looks(), graph.vertex_count());
  const auto sample = [&](int points, const Deadline& deadline) {
    static_cast<void>(SamplePolyhedron(body, Radians(15), planning::Spanning::kAdaptive, region,
                                       points, 1, deadline));
  };
  const CountedDeadline none;
  sample(0, none.deadline());
  const CountedDeadline never;
  sample(100, never.deadline());
  EXPECT_EQ(never.looks(), none.looks() + 100);
  ExpectEndsWhereverItComes(never.looks(),
                            [&](const Deadline& deadline) { sample(100, deadline); });
}

}  // namespace deadline_test
}  // namespace regrasp::polyhedron
