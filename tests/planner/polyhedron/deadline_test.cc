#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/polyhedron/normal_quadruples.h"
#include "planner/polyhedron/plan_polyhedron.h"
#include "tests/planner/counted_deadline.h"
#include "tests/planner/polyhedron/bodies.h"

namespace regrasp {
namespace {

using ::testing::HasSubstr;

TEST(PolyhedronDeadline, TheGraphLooksAtItForEveryCandidateAndCellAndEndsWhereverItComes) {
  const Polyhedron body = RegularOctahedron();
  const CountedDeadline never;
  const PolyhedronGraph graph(body, Radians(15), Spanning::kAdaptive, never.deadline());
  ASSERT_GT(graph.vertex_count(), 0);
  const CountedDeadline listing;
  static_cast<void>(FindQuadrupleCandidates(body, std::tan(Radians(15)), Spanning::kAdaptive,
                                            listing.deadline()));
  EXPECT_EQ(listing.looks(), 2 * (8 * 7 / 2));  // each pair of faces twice
  // Cells are joined on each of their four triples of faces.
  EXPECT_EQ(never.looks(), listing.looks() + graph.candidate_count() + 4 * graph.vertex_count());
  for (int look = 1; look <= never.looks(); look += 1 + look / 10) {
    const CountedDeadline counted(look);
    EXPECT_THROW((void)PolyhedronGraph(body, Radians(15), Spanning::kAdaptive, counted.deadline()),
                 TimeUp)
        << look;
    EXPECT_EQ(counted.looks(), look);
  }
}

TEST(PolyhedronDeadline, EndsAPlanWhereverItComes) {
  const Polyhedron body = RegularOctahedron();
  const GraspChoice random = {GraspChoice::Kind::kRandom, {}, "random"};
  PolyhedronPlanOptions options;
  options.half_angle = Radians(15);
  const CountedDeadline never;
  options.deadline = never.deadline();
  ASSERT_TRUE(PlanOnPolyhedron(body, random, random, options).plan);
  int ended = 0;
  for (int look = 1; look <= never.looks(); look += 1 + look / 5) {
    options.deadline = CountedDeadline(look).deadline();
    const PlanResult result = PlanOnPolyhedron(body, random, random, options);
    if (result.plan) continue;  // of a random goal that is not as good
    EXPECT_THAT(result.message, HasSubstr("the planner polyhedron when the time was up"));
    ++ended;
  }
  EXPECT_GT(ended, 10);
}

}  // namespace
}  // namespace regrasp
