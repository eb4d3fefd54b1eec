#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/error.h"
#include "planner/certificate/align_certificate.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/tree/tree_planner.h"
#include "tests/fixtures/plan_with.h"
#include "tests/planner/tree/search_cases.h"

namespace regrasp::tree {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using Kind = GraspChoice::Kind;
using Status = PlanResult::Status;

PlanRequest Options(double degrees, std::uint64_t seed = 0) {
  PlanRequest options;
  options.criteria.half_angle = Radians(degrees);
  options.seed = seed;
  return options;
}

class PlanGeneralOnModel : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Models, PlanGeneralOnModel,
                         testing::Values("cube.obj", "prism.obj", "hole_block.obj", "duck500.obj",
                                         "polygon20.wkt", "polygon_hole.wkt"),
                         [](const auto& test) { return "model" + std::to_string(test.index); });

TEST_P(PlanGeneralOnModel, RandomGraspsAreJoinedByGoodGraspsAndTheCheckerPasses) {
  const ObjectFile file = ReadModel(GetParam());
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const PlanResult result =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), Options(15, seed));
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    EXPECT_THAT(result.warnings, testing::IsEmpty());
    EXPECT_EQ(result.plan->planner, "general");
    EXPECT_EQ(result.plan->fingers, file.object->dimension() == 3 ? 5 : 4);
    EXPECT_GT(result.margin, 0);
    EXPECT_THAT(result.notes, SizeIs(2));
    EXPECT_TRUE(CheckPlan(*file.object, *result.plan).passed()) << seed;
  }
}

TEST(PlanGeneralTest, AlignsAreProvedAtTheFrictionThatIsAskedForAlsoWithoutAQuality) {
  int aligns = 0;
  for (const char* model : {"cube.obj", "pyramid.obj", "polygon15.wkt"}) {
    const ObjectFile file = ReadModel(model);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(model + std::to_string(seed));
      PlanRequest options = Options(seed % 2 == 0 ? 5 : 15, seed);
      options.criteria.min_quality = 0;
      const PlanResult result = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
      ASSERT_TRUE(result.plan) << result.message;
      for (const StepCheck& step : CheckPlan(*file.object, *result.plan).steps) {
        EXPECT_EQ(step.reason, Reason::kNone) << step.detail;
        EXPECT_EQ(step.undecided, 0);
        aligns += step.kind == "align" ? 1 : 0;
      }
    }
  }
  EXPECT_GE(aligns, 10);
}

TEST(PlanGeneralTest, TheSameArgumentsGiveTheSameBytesAndAnotherSeedAnotherPlan) {
  const ObjectFile file = ReadModel("l_block.obj");
  const auto plan = [&](std::uint64_t seed) {
    const PlanResult result =
        PlanWith(TreePlanner(), *file.object, Random(), Random(), Options(10, seed));
    return FormatPlan(result.plan.value());
  };
  EXPECT_EQ(plan(4), plan(4));
  EXPECT_NE(plan(4), plan(5));
}

TEST(PlanGeneralTest, ThreeAndFiveContactsInSpaceAndFourInThePlaneServe) {
  const auto joins = [](const char* model, int from, int to) {
    const ObjectFile file = ReadModel(model);
    RandomStream draws(1, RandomUse::kStart);
    const GraspCriteria criteria{Radians(25), 0.01};
    const Grasp start = DrawGrasp(*file.object, from, criteria, draws);
    const Grasp goal = DrawGrasp(*file.object, to, criteria, draws);
    const PlanResult result =
        PlanWith(TreePlanner(), *file.object, Given(start), Given(goal), Options(25));
    ASSERT_EQ(result.status, Status::kFound) << result.message;
    EXPECT_THAT(result.plan->initial, SizeIs(from));
    EXPECT_THAT(result.plan->goal, SizeIs(to));
    EXPECT_TRUE(CheckPlan(*file.object, *result.plan).passed());
  };
  joins("cube.obj", 3, 5);
  joins("cube.obj", 5, 3);
  joins("polygon20.wkt", 4, 2);
}

TEST(PlanGeneralTest, FiveContactsOfWhichNoFourHoldAreAlignedFirst) {
  const ObjectFile file = ReadModel("cube.obj");
  const GraspCriteria criteria{Radians(10), 0};
  RandomStream draws(1, RandomUse::kStart);
  Grasp five;
  for (int draw = 0; draw < 2000 && five.empty(); ++draw) {
    const Grasp grasp = DrawGrasp(*file.object, 5, criteria, draws);
    SearchSpace space(*file.object, criteria);
    const ContactSet all = space.Add(grasp);
    bool some = false;
    for (const int contact : all) some = some || space.Admits(all.Without(contact));
    if (!some) five = grasp;
  }
  ASSERT_THAT(five, SizeIs(5)) << "no such grasp was drawn";
  const Grasp goal = DrawGrasp(*file.object, 4, criteria, draws);
  PlanRequest options = Options(10);
  options.criteria.min_quality = 0;
  const PlanResult result =
      PlanWith(TreePlanner(), *file.object, Given(five), Given(goal), options);
  ASSERT_EQ(result.status, Status::kFound) << result.message;
  EXPECT_TRUE(std::holds_alternative<Align>(result.plan->steps.front()));
  EXPECT_TRUE(CheckPlan(*file.object, *result.plan).passed());
}

TEST(PlanGeneralTest, AGoalEqualToTheStartGivesNoSteps) {
  const ObjectFile file = ReadModel("cube.obj");
  RandomStream draws(3, RandomUse::kStart);
  Grasp grasp = DrawGrasp(*file.object, 4, {Radians(25), 0.01}, draws);
  const Grasp start = grasp;
  std::swap(grasp[0], grasp[2]);
  const PlanResult result =
      PlanWith(TreePlanner(), *file.object, Given(start), Given(grasp), Options(25));
  ASSERT_TRUE(result.plan);
  EXPECT_THAT(result.plan->steps, testing::IsEmpty());
}

TEST(PlanGeneralTest, AnEffortTooSmallSaysWhatWasReachedAndExplainFindsTheFriction) {
  const ObjectFile file = ReadModel("pyramid.obj");
  PlanRequest options = Options(5);
  options.criteria.min_quality = 0;
  int none = 0;
  for (options.seed = 0; options.seed < 40 && none == 0; ++options.seed) {
    options.effort = 1;
    options.explain = false;
    const PlanResult result = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    if (result.status == Status::kFound) continue;
    ++none;
    EXPECT_EQ(result.status, Status::kNoSequence);
    EXPECT_THAT(result.message, HasSubstr("were reached from the start"));
    EXPECT_THAT(result.message, HasSubstr("failure is not a proof of infeasibility"));
    options.effort = 40'000;
    options.explain = true;
    const PlanResult more = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    if (more.status != Status::kFound) {
      EXPECT_THAT(more.message, HasSubstr("upper bound by search"));
    }
  }
  EXPECT_EQ(none, 1);
}

TEST(PlanGeneralTest, ATimeLimitEndsTheSearchAndSaysSo) {
  const ObjectFile file = ReadModel("cube.obj");
  RandomStream draws(2, RandomUse::kStart);
  const Grasp from = DrawGrasp(*file.object, 5, {Radians(4), 0}, draws);
  const Grasp to = DrawGrasp(*file.object, 5, {Radians(4), 0}, draws);
  PlanRequest options = Options(4);
  options.deadline = std::chrono::steady_clock::now();
  const PlanResult result = PlanWith(TreePlanner(), *file.object, Given(from), Given(to), options);
  if (result.status == Status::kNoSequence) {
    EXPECT_THAT(result.message, HasSubstr("the time was up"));
  }
}

TEST(PlanGeneralTest, RandomGraspsAreNotDrawnWhenTheTimeIsUp) {
  for (const char* model : {"cube.obj", "triangle.wkt"}) {
    const ObjectFile file = ReadModel(model);
    PlanRequest options = Options(20);
    EXPECT_TRUE(PlanWith(TreePlanner(), *file.object, Random(), Random(), options).plan);
    options.deadline = std::chrono::steady_clock::now();
    const PlanResult result = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    EXPECT_EQ(result.status, Status::kNoSequence);
    EXPECT_THAT(result.message, HasSubstr("the time was up"));
  }
}

TEST(PlanGeneralTest, ObjectivesAreWhatTheySay) {
  const ObjectFile file = ReadModel("prism.obj");
  double wider = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    PlanRequest options = Options(15, seed);
    const PlanResult steps = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    options.objective = Objective::kMargin;
    const PlanResult margin = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    options.objective = Objective::kTravel;
    const PlanResult travel = PlanWith(TreePlanner(), *file.object, Random(), Random(), options);
    ASSERT_TRUE(steps.plan && margin.plan && travel.plan);
    EXPECT_LE(steps.plan->steps.size(), margin.plan->steps.size());
    wider += margin.margin - steps.margin;
    for (const PlanResult* result : {&steps, &margin, &travel}) {
      const char* gained = result == &travel ? "travel of all fingers" : "margin ";
      EXPECT_THAT(result->notes, ElementsAre(HasSubstr("steps: "), HasSubstr(gained)));
    }
    EXPECT_TRUE(CheckPlan(*file.object, *travel.plan).passed());
    EXPECT_TRUE(CheckPlan(*file.object, *margin.plan).passed());
  }
  EXPECT_GE(wider, 0);
}

TEST(PlanGeneralTest, RefusesGraspsThatAHandCannotHold) {
  const ObjectFile file = ReadModel("cube.obj");
  RandomStream draws(2, RandomUse::kStart);
  const Grasp good = DrawGrasp(*file.object, 4, {Radians(25), 0}, draws);
  Grasp six = good;
  six.insert(six.end(), good.begin(), good.begin() + 2);
  EXPECT_THROW((void)PlanWith(TreePlanner(), *file.object, Given(six), Given(good), Options(25)),
               InputError);
  const Grasp two(good.begin(), good.begin() + 2);
  EXPECT_THROW((void)PlanWith(TreePlanner(), *file.object, Given(good), Given(two), Options(25)),
               InputError);
  EXPECT_THROW((void)PlanWith(TreePlanner(), *file.object, Given(good), Given(good), Options(0.01)),
               InputError);
}

}  // namespace
}  // namespace regrasp::tree
