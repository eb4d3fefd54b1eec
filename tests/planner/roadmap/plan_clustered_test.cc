#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_planner.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/plan_with.h"
#include "tests/fixtures/solids.h"
#include "tests/planner/roadmap/small_meshes.h"

namespace regrasp::roadmap {
namespace plan_clustered_test {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using Status = planning::PlanResult::Status;

planning::PlanRequest Options(std::uint64_t seed = 0, double degrees = 10, int clusters = 30) {
  planning::PlanRequest options = RequestAt(degrees, seed);
  options.parameters.Edit<RoadmapParameters>().contact_points = 1000;
  options.parameters.Edit<RoadmapParameters>().clusters = clusters;
  return options;
}

class PlanOnModel : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, PlanOnModel,
                         testing::Values("ellipsoid500", "mug500", "spanner500"),
                         [](const auto& model) { return std::string(model.param); });

TEST_P(PlanOnModel, EveryPlanPassesTheChecker) {
  const object::Polyhedron solid = ReadMesh(GetParam());
  constexpr int kQueries = 3;
  for (std::uint64_t seed = 0; seed < kQueries; ++seed) {
    for (const planning::GraspChoice& choice : {Random(), RandomAny()}) {
      const planning::PlanResult result =
          PlanWith(RoadmapPlanner(), solid, choice, choice, Options(seed));
      ASSERT_EQ(result.status, Status::kFound) << "seed " << seed << ": " << result.message;
      EXPECT_TRUE(plan::CheckPlan(solid, *result.plan).passed()) << "seed " << seed;
      EXPECT_FALSE(result.plan->steps.empty());
      EXPECT_GE(result.margin, 0);
      EXPECT_EQ(result.plan->planner, "roadmap");
      EXPECT_EQ(result.plan->fingers, kRoadmapFingers);
      ASSERT_TRUE(result.plan->roadmap.has_value());
      EXPECT_EQ(result.plan->roadmap->clusters, 30);
      EXPECT_EQ(result.plan->roadmap->contacts, 1000);
      EXPECT_EQ(result.plan->roadmap->seed, seed);
      EXPECT_THAT(result.plan->roadmap->start, ContainsRegex("^(vertex|algorithm-|last-resort)"));
      EXPECT_THAT(result.plan->roadmap->goal, ContainsRegex("^(vertex|algorithm-|last-resort)"));
    }
  }
  // Control: the checker rejects the plan at low friction.
  plan::Plan plan = *PlanWith(RoadmapPlanner(), solid, Random(), Random(), Options()).plan;
  plan.friction_angle = Radians(0.5);
  EXPECT_FALSE(plan::CheckPlan(solid, plan).passed());
}

TEST_P(PlanOnModel, KeepsToGoodGraspsOrWarns) {
  const object::Polyhedron solid = ReadMesh(GetParam());
  int good = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const planning::PlanRequest options = Options(seed);
    const planning::PlanResult result =
        PlanWith(RoadmapPlanner(), solid, Random(), Random(), options);
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    const bool all_good =
        std::ranges::all_of(RestsOf(*result.plan), [&](const grasp::Grasp& grasp) {
          return grasp::QualityAtLeast(grasp, solid.wrench_frame(), options.criteria.friction_angle,
                                       options.criteria.min_quality);
        });
    EXPECT_EQ(result.warnings.empty(), all_good) << "seed " << seed;
    if (all_good) ++good;
  }
  EXPECT_GT(good, 0);
}

TEST(PlanOnClusters, GivesTheSameBytesForTheSameSeed) {
  const object::Polyhedron mug = ReadMesh("mug500");
  const auto plan = [&](std::uint64_t seed) {
    return plan::FormatPlan(
        *PlanWith(RoadmapPlanner(), mug, Random(), RandomAny(), Options(seed)).plan);
  };
  EXPECT_EQ(plan(3), plan(3));
  EXPECT_NE(plan(3), plan(4));
}

TEST(PlanOnClusters, DependsNeitherOnTheUnitOfLengthNorOnThePose) {
  int checked = 0;
  for (const char* name : {"duck500", "star500"}) {
    const object::Polyhedron solid = ReadMesh(name);
    const planning::PlanResult here =
        PlanWith(RoadmapPlanner(), solid, Random(), Random(), Options(2));
    ASSERT_EQ(here.status, Status::kFound) << here.message;
    for (const double unit : {1.0, 1000.0}) {
      const Eigen::Affine3d motion = MotionAndUnit(unit);
      const object::Polyhedron moved = regrasp::Moved(solid, motion);
      const planning::PlanResult there = PlanWith(
          RoadmapPlanner(), moved, Given(Moved(plan::ContactsOf(here.plan->initial), motion)),
          Given(Moved(here.plan->goal, motion)), Options(2));
      ASSERT_EQ(there.status, Status::kFound) << there.message;
      ASSERT_EQ(there.plan->steps.size(), here.plan->steps.size());
      plan::FingerGrasp a = here.plan->initial;
      plan::FingerGrasp b = there.plan->initial;
      for (std::size_t i = 0; i < here.plan->steps.size(); ++i) {
        a = plan::GraspAfter(a, here.plan->steps[i]);
        b = plan::GraspAfter(b, there.plan->steps[i]);
        const grasp::Grasp expected = Moved(plan::ContactsOf(a), motion);
        const grasp::Grasp actual = plan::ContactsOf(b);
        ASSERT_EQ(actual.size(), expected.size());
        for (std::size_t k = 0; k < actual.size(); ++k) {
          EXPECT_EQ(b[k].finger, a[k].finger);
          EXPECT_LT((actual[k].p - expected[k].p).norm(), 1e-9 * moved.diameter());
        }
      }
      EXPECT_NEAR(there.margin, here.margin, 1e-6);
      EXPECT_TRUE(plan::CheckPlan(moved, *there.plan).passed());
      ++checked;
    }
  }
  EXPECT_EQ(checked, 4);
}

TEST(PlanOnClusters, HasNoStepsWhereTheGoalIsTheStartInAnyOrder) {
  const object::Polyhedron mug = ReadMesh("mug500");
  const grasp::Grasp start = plan::ContactsOf(
      PlanWith(RoadmapPlanner(), mug, Random(), Random(), Options()).plan->initial);
  grasp::Grasp goal = start;
  std::reverse(goal.begin(), goal.end());
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), mug, Given(start), Given(goal), Options());
  ASSERT_EQ(result.status, Status::kFound);
  EXPECT_THAT(result.plan->steps, IsEmpty());
  EXPECT_TRUE(plan::CheckPlan(mug, *result.plan).passed());
}

/// Cube with two grasps at low friction. No contact of either grasp can be replaced, except by a
/// contact on the same line of force.
struct Isolated {
  object::Polyhedron cube = MakeBox({0.06, 0.06, 0.06}, 8);
  grasp::Contact On(int axis, int sign, double u, double v) const {
    grasp::Contact contact;
    contact.p[axis] = sign * 0.03;
    contact.p[(axis + 1) % 3] = u;
    contact.p[(axis + 2) % 3] = v;
    contact.face = cube.FacesNear(contact.p, object::kPointTolerance * cube.diameter()).front();
    contact.n = cube.inward_normal(contact.face);
    return contact;
  }
  grasp::Grasp Pinwheel(int axis) const {
    constexpr double kArm = 0.0201;
    const int other = (axis + 1) % 3;
    return {On(axis, 1, kArm, 0), On(axis, -1, -kArm, 0), On(other, 1, 0, kArm),
            On(other, -1, 0, -kArm)};
  }
};

TEST(PlanOnClusters, SaysThatAllWasSearchedWhereAGraspIsIsolated) {
  const Isolated isolated;
  planning::PlanRequest options = Options(0, 0.5, 10);
  options.parameters.Edit<RoadmapParameters>().contact_points = 100;
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), isolated.cube, Given(isolated.Pinwheel(0)),
               Given(isolated.Pinwheel(1)), options);
  ASSERT_EQ(result.status, Status::kNoSequence);
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_THAT(
      result.message,
      HasSubstr(
          "no sequence exists over these points: the fallback search reached all of 1 grasps"));
  options.parameters.Edit<RoadmapParameters>().last_resort = false;
  const planning::PlanResult without =
      PlanWith(RoadmapPlanner(), isolated.cube, Given(isolated.Pinwheel(0)),
               Given(isolated.Pinwheel(1)), options);
  ASSERT_EQ(without.status, Status::kNoSequence);
  EXPECT_THAT(without.message, Not(HasSubstr("last resort")));
  options.criteria.friction_angle = Radians(20);
  EXPECT_EQ(PlanWith(RoadmapPlanner(), isolated.cube, Given(isolated.Pinwheel(0)),
                     Given(isolated.Pinwheel(1)), options)
                .status,
            Status::kFound);
}

TEST(PlanOnClusters, WithoutTheLastResortCanFailWhereItFinds) {
  const object::Polyhedron spanner = ReadMesh("spanner500");
  int failed = 0;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 30 && (found == 0 || failed == 0); ++seed) {
    planning::PlanRequest options = Options(seed);
    options.parameters.Edit<RoadmapParameters>().last_resort = false;
    const planning::PlanResult without =
        PlanWith(RoadmapPlanner(), spanner, Random(), RandomAny(), options);
    ++(without.status == Status::kFound ? found : failed);
    options.parameters.Edit<RoadmapParameters>().last_resort = true;
    EXPECT_EQ(PlanWith(RoadmapPlanner(), spanner, Random(), RandomAny(), options).status,
              Status::kFound);
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(failed, 0);
}

TEST(PlanOnClusters, MovesNoFingerToItsOwnPointOnABorder) {
  const Isolated isolated;
  // A contact on the border of two faces of the cube, with either normal.
  grasp::Grasp start = {isolated.On(0, 1, 0.03, 0.0), isolated.On(0, -1, 0.02, 0.001),
                        isolated.On(1, 1, 0.013, 0.012), isolated.On(1, -1, -0.013, 0.011)};
  grasp::Grasp goal = start;
  const auto face_of = [&](int axis) {
    const auto faces = isolated.cube.FacesNear(start[0].p, object::kPointTolerance * 0.1);
    return *std::find_if(faces.begin(), faces.end(), [&](FaceIndex face) {
      return isolated.cube.inward_normal(face)[axis] < -0.9;
    });
  };
  start[0].face = face_of(0);
  start[0].n = isolated.cube.inward_normal(start[0].face);
  goal[0].face = face_of(1);
  goal[0].n = isolated.cube.inward_normal(goal[0].face);
  planning::PlanRequest options = Options(0, 40, 10);
  options.parameters.Edit<RoadmapParameters>().contact_points = 100;
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), isolated.cube, Given(start), Given(goal), options);
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  EXPECT_GT(result.plan->steps.size(), 1u);
  EXPECT_TRUE(plan::CheckPlan(isolated.cube, *result.plan).passed());
}

TEST(PlanOnClusters, CannotDrawAGraspBetterThanAll) {
  planning::PlanRequest options = Options();
  options.criteria.min_quality = 0.9;
  const planning::PlanResult result =
      PlanWith(RoadmapPlanner(), ReadMesh("mug500"), Random(), Random(), options);
  EXPECT_EQ(result.status, Status::kNoGrasp);
  EXPECT_THAT(result.message, HasSubstr("500 contact points"));
}

TEST(PlanOnClusters, RefusesOptionsOutOfRange) {
  const object::Polyhedron body = MakeConvexBody(22, 1);
  const auto plan = [&](int contacts, int clusters) {
    planning::PlanRequest options = Options(0, 20, clusters);
    options.parameters.Edit<RoadmapParameters>().contact_points = contacts;
    return PlanWith(RoadmapPlanner(), body, Random(), Random(), options);
  };
  EXPECT_THROW((void)plan(3, 10), std::invalid_argument);
  EXPECT_THROW((void)plan(kMaxClusteredContacts + 1, 10), std::invalid_argument);
  EXPECT_THROW((void)plan(40, kFewestClusters - 1), std::invalid_argument);
  EXPECT_THROW((void)plan(40, kMostClusters + 1), std::invalid_argument);
  EXPECT_EQ(plan(40, 10).status, Status::kFound);
}

TEST(RoadmapSizeOf, ClustersMeshesAndManyContacts) {
  const auto sizes = [](const object::Polyhedron& solid, std::optional<int> contacts,
                        std::optional<int> clusters) {
    const RoadmapSize size =
        SizeOf({.object = &solid,
                .parameters = RoadmapParameters{.contact_points = contacts, .clusters = clusters}});
    return std::pair(size.contacts, size.clusters);
  };
  const object::Polyhedron few = MakeConvexBody(22, 1);
  const object::Polyhedron many = ReadMesh("mug500");
  EXPECT_EQ(sizes(few, {}, {}), std::pair(60, 0));
  EXPECT_EQ(sizes(many, {}, {}), std::pair(1000, 50));
  EXPECT_EQ(sizes(few, {}, 20), std::pair(1000, 20));
  EXPECT_EQ(sizes(many, kMaxRoadmapContacts, {}), std::pair(kMaxRoadmapContacts, 0));
  EXPECT_EQ(sizes(few, kMaxRoadmapContacts + 1, {}), std::pair(kMaxRoadmapContacts + 1, 50));
  EXPECT_EQ(sizes(few, 40, 10), std::pair(40, 10));
}

TEST(PlanOnClusters, HasNoMoreClustersThanContacts) {
  const object::Polyhedron body = MakeConvexBody(22, 1);
  for (const int contacts : {4, 5, 8}) {
    planning::PlanRequest options = Options(0, 20, 50);
    options.parameters.Edit<RoadmapParameters>().contact_points = contacts;
    options.object = &body;
    const ClusteredRoadmap roadmap = BuildClusteredRoadmap(options);
    EXPECT_LT(roadmap.clusters.cluster_count(), roadmap.clusters.clustered_count());
    EXPECT_GT(roadmap.clusters.cluster_count(), 0);
    EXPECT_NO_THROW((void)PlanWith(RoadmapPlanner(), body, RandomAny(), RandomAny(), options));
  }
}

TEST(PlanOnClusters, RefusesAStartThatIsNotForceClosure) {
  const Isolated isolated;
  planning::PlanRequest options = Options(0, 0.5, 10);
  options.parameters.Edit<RoadmapParameters>().contact_points = 100;
  grasp::Grasp start = isolated.Pinwheel(0);
  start[2] = isolated.On(0, 1, -0.01, 0.01);
  EXPECT_THROW((void)PlanWith(RoadmapPlanner(), isolated.cube, Given(start),
                              Given(isolated.Pinwheel(1)), options),
               InputError);
}

}  // namespace plan_clustered_test
}  // namespace regrasp::roadmap
