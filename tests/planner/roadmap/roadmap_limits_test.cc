#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/number.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_planner.h"
#include "tests/fixtures/counted_deadline.h"
#include "tests/fixtures/peak_memory.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/solids.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace roadmap_limits_test {

using ::testing::HasSubstr;

planning::PlanRequest Options(int contacts, int clusters, double degrees) {
  planning::PlanRequest options = RequestAt(degrees);
  options.parameters.Edit<RoadmapParameters>().contact_points = contacts;
  options.parameters.Edit<RoadmapParameters>().clusters = clusters;
  return options;
}

MemoryNeed NeedOf(const object::Polyhedron& body, planning::PlanRequest request) {
  request.object = &body;
  return EstimateRoadmap(request);
}

#if !defined(__SANITIZE_ADDRESS__)  // the address sanitizer keeps freed memory
TEST(RoadmapMemory, TheEstimateIsWithinAFactorOfTwoOfWhatIsUsed) {
  const object::Polyhedron box = MakeBox({0.06, 0.05, 0.03});
  const object::Polyhedron mesh = MakeConvexBody(100, 1);
  struct Case {
    const object::Polyhedron& body;
    planning::PlanRequest options;
  };
  for (const auto& [body, options] :
       {Case{box, Options(80, 0, 60)}, Case{box, Options(100, 0, 20)},
        Case{mesh, Options(80, 0, 35)}, Case{box, Options(400, 80, 40)},
        Case{box, Options(1200, 10, 30)}}) {
    const double used = PeakBytesOf([&, &body = body, &options = options] {
      static_cast<void>(PlanWith(RoadmapPlanner(), body, Random(), Random(), options));
    });
    const double estimate = NeedOf(body, options).bytes();
    const auto parameters = options.parameters.Get<RoadmapParameters>();
    SCOPED_TRACE(std::to_string(*parameters.contact_points) + " contacts, " +
                 std::to_string(*parameters.clusters) + " clusters");
    ASSERT_GT(used, 1e7);
    EXPECT_GT(estimate, used / 2);
    EXPECT_LT(estimate, used * 2);
  }
}
#endif

TEST(RoadmapMemory, TheEstimateGrowsWithTheContactPointsAndNotWithTheMesh) {
  double last = 0;
  for (const int contacts : {4, 10, 30, 100, kMaxRoadmapContacts}) {
    const MemoryNeed need = NeedOf(MakeBox({0.06, 0.06, 0.06}), Options(contacts, 0, 30));
    EXPECT_EQ(need.count, contacts);
    EXPECT_GT(need.bytes(), last) << contacts;
    last = need.bytes();
  }
  EXPECT_GT(last, 1e8);
  const double coarse = NeedOf(MakeBox({1, 1, 1}, 1), Options(100, 0, 30)).bytes();
  const double fine = NeedOf(MakeBox({1, 1, 1}, 20), Options(100, 0, 30)).bytes();
  EXPECT_NEAR(fine / coarse, 1, 0.2);
}

TEST(RoadmapMemory, APlanOnARoadmapThatDoesNotFitIsNone) {
  planning::PlanRequest options = Options(kMaxRoadmapContacts, 0, 40);
  options.memory = 1e8;
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), MakeBox({0.06, 0.06, 0.06}), Random(), Random(), options);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(result.message, HasSubstr("200 contact points require"));
  options = Options(kMaxClusteredContacts, 20, 40);
  options.memory = 1e8;
  EXPECT_THAT(
      PlanWith(RoadmapPlanner(), MakeBox({0.06, 0.06, 0.06}), Random(), Random(), options).message,
      HasSubstr("4000 contact points require"));
}

TEST(RoadmapDeadline, EndsAPlanWhereverItComes) {
  for (const int clusters : {0, 10}) {
    planning::PlanRequest options = Options(clusters > 0 ? 60 : 14, clusters, 30);
    const CountedDeadline never;
    options.deadline = never.deadline();
    ASSERT_TRUE(
        PlanWith(RoadmapPlanner(), MakeBox({0.06, 0.06, 0.06}), Random(), Random(), options).plan)
        << clusters;
    EXPECT_GT(never.looks(), 80) << clusters;  // one check per pair of contact points
    for (int look = 1; look <= never.looks(); look += 1 + look / 5) {
      options.deadline = CountedDeadline(look).deadline();
      const planning::PlanResult result =
          PlanWith(RoadmapPlanner(), MakeBox({0.06, 0.06, 0.06}), Random(), Random(), options);
      EXPECT_FALSE(result.plan.has_value()) << look;
      EXPECT_THAT(result.message, HasSubstr("planner roadmap: time limit reached"));
    }
  }
}

}  // namespace roadmap_limits_test
}  // namespace regrasp::roadmap
