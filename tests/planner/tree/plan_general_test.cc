#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/certificate/align_certificate.h"
#include "planner/plan/check.h"
#include "planner/tree/tree_planner.h"
#include "tests/fixtures/good_plan.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace plan_general_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using Status = planning::PlanResult::Status;

class PlanGeneralOnModel : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, PlanGeneralOnModel,
                         testing::Values("cube.obj", "prism.obj", "hole_block.obj", "duck500.obj",
                                         "polygon20.wkt", "polygon_hole.wkt"),
                         [](const auto& test) { return "model" + std::to_string(test.index); });

TEST_P(PlanGeneralOnModel, RandomGraspsAreJoinedByGoodGraspsAndTheCheckerPasses) {
  const object::ObjectFile file = ReadModel(GetParam());
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const planning::PlanResult result =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), RequestAt(15, seed));
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    EXPECT_THAT(result.warnings, testing::IsEmpty());
    EXPECT_GT(result.margin, 0);
    EXPECT_THAT(result.notes, testing::IsEmpty());
    ExpectGoodPlan(TreePlanner(), *file.object, result);
  }
}

TEST(PlanGeneralTest, AlignsAreProvedAtTheFrictionThatIsAskedForAlsoWithoutAQuality) {
  int aligns = 0;
  for (const char* model : {"cube.obj", "pyramid.obj", "polygon15.wkt"}) {
    const object::ObjectFile file = ReadModel(model);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(model + std::to_string(seed));
      planning::PlanRequest options = RequestAt(seed % 2 == 0 ? 5 : 15, seed);
      options.criteria.min_quality = 0;
      const planning::PlanResult result =
          PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
      ASSERT_TRUE(result.plan) << result.message;
      for (const plan::StepCheck& step : plan::CheckPlan(*file.object, *result.plan).steps) {
        EXPECT_EQ(step.reason, plan::Reason::kNone) << step.detail;
        EXPECT_EQ(step.undecided, 0);
        aligns += step.kind == "align" ? 1 : 0;
      }
    }
  }
  EXPECT_GE(aligns, 10);
}

TEST(SearchSpaceTest, HasTheFingersOfTheHandButNoMoreThanHoldAtOnce) {
  const object::ObjectFile solid = ReadModel("cube.obj");
  const object::ObjectFile planar = ReadModel("polygon15.wkt");
  const auto fingers = [](const object::ObjectFile& file, int of_hand) {
    return SearchSpace(*file.object, {Radians(15), 0}, {.fingers = of_hand}).fingers();
  };
  EXPECT_EQ(fingers(solid, 0), hand::kFingersInSpace);
  EXPECT_EQ(fingers(planar, 0), hand::kFingersInPlane);
  EXPECT_EQ(fingers(solid, 4), 4);
  EXPECT_EQ(fingers(planar, 3), 3);
  EXPECT_EQ(fingers(planar, 5), 5);
  EXPECT_EQ(fingers(solid, 6), criteria::ContactSet::kMostHeld);
}

TEST(PlanGeneralTest, AHandWithMoreFingersLeavesSomeFree) {
  for (const char* model : {"cube.obj", "polygon15.wkt"}) {
    const object::ObjectFile file = ReadModel(model);
    planning::PlanRequest options = RequestAt(15, 1);
    options.hand.fingers = 7;
    const planning::PlanResult result =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    ASSERT_TRUE(result.plan) << result.message;
    EXPECT_EQ(result.plan->fingers, 7);
    EXPECT_TRUE(plan::CheckPlan(*file.object, *result.plan).passed());
  }
}

TEST(PlanGeneralTest, ThreeAndFiveContactsInSpaceAndFourInThePlaneAreTaken) {
  const auto joins = [](const char* model, int from, int to) {
    const object::ObjectFile file = ReadModel(model);
    RandomStream draws(1, RandomUse::kStart);
    const criteria::GraspCriteria criteria{Radians(25), 0.01};
    const grasp::Grasp start = DrawGrasp(*file.object, from, criteria, draws);
    const grasp::Grasp goal = DrawGrasp(*file.object, to, criteria, draws);
    const planning::PlanResult result =
        PlanWith(TreePlanner(), *file.object, Given(start), Given(goal), RequestAt(25));
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    EXPECT_THAT(result.plan->initial, SizeIs(from));
    EXPECT_THAT(result.plan->goal, SizeIs(to));
    EXPECT_TRUE(plan::CheckPlan(*file.object, *result.plan).passed());
  };
  joins("cube.obj", 3, 5);
  joins("cube.obj", 5, 3);
  joins("polygon20.wkt", 4, 2);
}

TEST(PlanGeneralTest, FiveContactsOfWhichNoFourHoldAreAlignedFirst) {
  const object::ObjectFile file = ReadModel("cube.obj");
  const criteria::GraspCriteria criteria{Radians(10), 0};
  RandomStream draws(1, RandomUse::kStart);
  grasp::Grasp five;
  for (int draw = 0; draw < 2000 && five.empty(); ++draw) {
    const grasp::Grasp grasp = DrawGrasp(*file.object, 5, criteria, draws);
    SearchSpace space(*file.object, criteria);
    const criteria::ContactSet all = space.Add(grasp);
    bool some = false;
    for (const int contact : all) some = some || space.Admits(all.Without(contact));
    if (!some) five = grasp;
  }
  ASSERT_THAT(five, SizeIs(5)) << "no such grasp was drawn";
  const grasp::Grasp goal = DrawGrasp(*file.object, 4, criteria, draws);
  planning::PlanRequest options = RequestAt(10);
  options.criteria.min_quality = 0;
  const planning::PlanResult result =
      PlanWith(TreePlanner(), *file.object, Given(five), Given(goal), options);
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  EXPECT_TRUE(std::holds_alternative<plan::Align>(result.plan->steps.front()));
  EXPECT_TRUE(plan::CheckPlan(*file.object, *result.plan).passed());
}

TEST(PlanGeneralTest, AnEffortTooSmallSaysWhatWasReachedAndExplainFindsTheFriction) {
  const object::ObjectFile file = ReadModel("pyramid.obj");
  planning::PlanRequest options = RequestAt(5);
  options.criteria.min_quality = 0;
  int none = 0;
  for (options.seed = 0; options.seed < 40 && none == 0; ++options.seed) {
    options.parameters.Edit<planning::SearchParameters>().budget = 1;
    options.parameters.Edit<planning::SearchParameters>().explain = false;
    const planning::PlanResult result =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    if (result.status == Status::kFound) continue;
    ++none;
    EXPECT_EQ(result.status, Status::kNoSequence);
    EXPECT_THAT(result.message, HasSubstr(" from the start and "));
    EXPECT_THAT(result.message, HasSubstr("this does not prove infeasibility"));
    options.parameters.Edit<planning::SearchParameters>().budget = 40'000;
    options.parameters.Edit<planning::SearchParameters>().explain = true;
    const planning::PlanResult more =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    if (more.status != Status::kFound) {
      EXPECT_THAT(more.message, HasSubstr("upper bound on the required one"));
    }
  }
  EXPECT_EQ(none, 1);
}

TEST(PlanGeneralTest, ObjectivesAreWhatTheySay) {
  const object::ObjectFile file = ReadModel("prism.obj");
  double wider = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    planning::PlanRequest options = RequestAt(15, seed);
    const planning::PlanResult steps =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    options.objective = planning::Objective::kMargin;
    const planning::PlanResult margin =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    options.objective = planning::Objective::kTravel;
    const planning::PlanResult travel =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    ASSERT_TRUE(steps.plan && margin.plan && travel.plan);
    EXPECT_LE(steps.plan->steps.size(), margin.plan->steps.size());
    wider += margin.margin - steps.margin;
    EXPECT_THAT(steps.notes, testing::IsEmpty());
    EXPECT_THAT(margin.notes, ElementsAre(HasSubstr("a friction margin of ")));
    EXPECT_THAT(travel.notes, ElementsAre(HasSubstr("total finger travel")));
    EXPECT_TRUE(plan::CheckPlan(*file.object, *travel.plan).passed());
    EXPECT_TRUE(plan::CheckPlan(*file.object, *margin.plan).passed());
  }
  EXPECT_GE(wider, 0);
}

}  // namespace plan_general_test
}  // namespace regrasp::tree
