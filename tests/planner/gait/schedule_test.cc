#include "planner/gait/schedule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/gait/plan_of_gait.h"
#include "planner/gait/rolling.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan_io.h"
#include "planner/plan/reason.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace schedule_test {

using Eigen::Vector3d;

/// Return the smallest force margin at rolled contacts over the keyframes of all in-hand motions.
double ForceMarginWhereItRolls(const Gait& gait, const GaitRequest& request,
                               const std::vector<grasp::Contact>& contacts) {
  const collision::BallContact surface(*request.solid, request.scale);
  const object::WrenchFrame frame = request.solid->wrench_frame();
  std::vector<std::optional<SurfacePoint>> rolled(gait.initial.size());
  const auto take = [&](FingerIndex finger, int contact) {
    rolled[finger] = {request.scale * contacts[contact].p, contacts[contact].n};
  };
  for (FingerIndex f{0}; f < std::ssize(gait.initial); ++f) {
    if (gait.initial[f] != kNone) take(f, gait.initial[f]);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const PlanSegment& segment : gait.segments) {
    if (segment.kind == PlanSegment::Kind::kPlace) take(segment.finger, segment.contact);
    if (segment.kind == PlanSegment::Kind::kRelease) rolled[segment.finger].reset();
    if (segment.kind != PlanSegment::Kind::kMove) continue;
    for (std::size_t i = 1; i < segment.path.size(); ++i) {
      grasp::Grasp grasp;
      for (FingerIndex f{0}; f < std::ssize(rolled); ++f) {
        if (!rolled[f]) continue;
        const kinematics::Finger& chain = request.hand->fingers[f];
        const auto ball = [&](const Keyframe& at) {
          return FingertipOrientation(chain, at.configurations[f], at.pose);
        };
        rolled[f] = Rolled(*rolled[f], ball(segment.path[i]) * ball(segment.path[i - 1]).inverse(),
                           chain.tip.radius, surface);
        grasp.push_back({rolled[f]->p / request.scale, rolled[f]->n, {}});
      }
      const Vector3d weight = -(segment.path[i].pose.linear().transpose() * request.hand->up);
      least = std::min(least,
                       grasp::ComputeGraspForces(grasp, frame, request.criteria.friction_angle,
                                                 {weight, Vector3d::Zero()}, kGraspForceOverWeight)
                           .margin);
    }
  }
  return least;
}

TEST(ScheduleTest, RobustGraspsWithstandTheWeightAtRolledContacts) {
  double worst_without = 1;
  for (int seed = 1; seed <= 4; ++seed) {
    GaitRequest request = RequestFor("cube", 0.8, 90);
    request.seed = seed;
    request.robustness = RobustnessLevel::kRequired;
    const GaitResult with = FindGait(request);
    ASSERT_TRUE(with.gait) << with.message;
    // The search checks grid poses only; in between the margin is slightly smaller.
    EXPECT_GT(ForceMarginWhereItRolls(*with.gait, request, with.contacts), 0.15);
    for (const PlanSegment& segment : with.gait->segments) {
      EXPECT_NE(segment.kind, PlanSegment::Kind::kSlide);
    }
    request.robustness = RobustnessLevel::kNone;
    const GaitResult without = FindGait(request);
    ASSERT_TRUE(without.gait);
    worst_without =
        std::min(worst_without, ForceMarginWhereItRolls(*without.gait, request, without.contacts));
  }
  EXPECT_LT(worst_without, 0);
}

TEST(ScheduleTest, ReportsThatRequiredRobustnessMayPreventAPlan) {
  GaitRequest request = RequestFor("cube", 0.8, 90);
  request.criteria.friction_angle = std::atan(0.15);
  request.robustness = RobustnessLevel::kRequired;
  request.most_expanded = 60;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("; robustness margins required"));
}

/// Simulated hand with prescribed results.
struct FakeHand {
  /// Whether a plan step executes, given that all earlier steps do.
  std::function<bool(const plan::Plan&, std::size_t)> executes;
  bool initial_grasp_holds = true;
  std::vector<plan::Plan> plans = {};

  void SimulateIn(GaitRequest& request) {
    request.simulate = [this](const plan::Plan& plan, const Deadline&) {
      plans.push_back(plan);
      planning::ExecutionResult execution{initial_grasp_holds, 0, false};
      execution.reason = plan::Reason::kSlipped;
      execution.detail = "finger 7 slipped, plan " + std::to_string(plans.size());
      if (!initial_grasp_holds) return std::optional(execution);
      while (execution.steps < std::ssize(plan.steps) && executes(plan, execution.steps)) {
        ++execution.steps;
      }
      execution.is_whole = execution.steps == std::ssize(plan.steps);
      return std::optional(execution);
    };
  }
};

bool PlacesFinger(const plan::Step& step, FingerIndex finger) {
  const auto* change = std::get_if<plan::Switch>(&step);
  return change != nullptr && std::ranges::any_of(change->place, [&](const auto& placed) {
           return placed.finger == finger;
         });
}

/// Return the rotation angle of the object in an in-hand motion, radians.
double TurnIn(const plan::Step& step) {
  const auto* move = std::get_if<plan::Move>(&step);
  if (move == nullptr) return 0;
  const Eigen::Matrix3d turn =
      move->path.front().pose.linear().transpose() * move->path.back().pose.linear();
  return Eigen::AngleAxisd(turn).angle();
}

TEST(ScheduleTest, TheResultIsThePlanThatExecutedInSimulation) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  // Finger that the unrestricted plan places and the simulator rejects.
  FingerIndex never_placed;
  const auto places_it = [&](const plan::Step& step) { return PlacesFinger(step, never_placed); };
  const auto is_placed = [&] {
    const GaitResult usual = FindGait(request);
    if (!usual.gait) return false;
    const plan::Plan plan = PlanOf(*usual.gait, request, usual.contacts);
    for (never_placed = FingerIndex{0}; never_placed < std::ssize(request.hand->fingers);
         ++never_placed) {
      if (std::ranges::any_of(plan.steps, places_it)) return true;
    }
    return false;
  };
  while (!is_placed()) ASSERT_LT(++request.seed, 10);
  FakeHand hand{.executes = [&](const plan::Plan& simulated, std::size_t i) {
    return !places_it(simulated.steps[i]);
  }};
  hand.SimulateIn(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  EXPECT_FALSE(std::ranges::any_of(plan.steps, places_it));
  EXPECT_EQ(plan::FormatPlan(plan), plan::FormatPlan(hand.plans.back()));
}

TEST(ScheduleTest, IfMotionsFailHalfwayFingersAreSwitchedEarlier) {
  constexpr double kMostTurn = 0.3;
  GaitRequest request = RequestFor("cube", 0.8, 90);
  FakeHand hand{.executes = [&](const plan::Plan& simulated, std::size_t i) {
    return TurnIn(simulated.steps[i]) <= kMostTurn;
  }};
  hand.SimulateIn(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  double most = 0;
  for (const plan::Step& step : plan.steps) most = std::max(most, TurnIn(step));
  EXPECT_LE(most, kMostTurn);
  request.simulate = nullptr;
  const GaitResult usual = FindGait(request);
  ASSERT_TRUE(usual.gait);
  most = 0;
  for (const plan::Step& step : PlanOf(*usual.gait, request, usual.contacts).steps) {
    most = std::max(most, TurnIn(step));
  }
  EXPECT_GT(most, kMostTurn);
}

/// The tolerance margin of the simulated hand depends on the number of plan steps.
TEST(ScheduleTest, SelectsTheExecutableGaitWithTheLargestToleranceMarginIfRequested) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  std::vector<std::string> plans;
  const auto margin_of = [](const plan::Plan& plan) {
    return 1.0 / static_cast<double>(2 + (7 * plan.steps.size()) % 5);
  };
  double most = 0;
  request.simulate = [&](const plan::Plan& plan, const Deadline&) {
    const int steps = static_cast<int>(plan.steps.size());
    plans.push_back(plan::FormatPlan(plan));
    most = std::max(most, margin_of(plan));
    return std::optional(planning::ExecutionResult{true, steps, true, margin_of(plan)});
  };
  const auto find = [&] {
    plans.clear();
    most = 0;
    const GaitResult found = FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    EXPECT_TRUE(ExecutesInSimulation(found));
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_EQ(found.execution->tolerance_margin, margin_of(plan));
    return plan;
  };
  const plan::Plan first = find();
  EXPECT_EQ(plan::FormatPlan(first), plans.back());
  request.seeks_most_margin = true;
  const plan::Plan best = find();
  EXPECT_GT(plans.size(), 1U);
  EXPECT_NE(plan::FormatPlan(best), plans.back());
  EXPECT_EQ(margin_of(best), most);
}

/// The gait with the smallest margin fails under the fewest conditions.
TEST(ScheduleTest, SelectsTheGaitThatFailsUnderTheFewestConditions) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  request.simulate = [&](const plan::Plan& plan, const Deadline&) {
    return std::optional(
        planning::ExecutionResult{true, static_cast<int>(plan.steps.size()), true,
                                  1.0 / static_cast<double>(1 + plan.steps.size())});
  };
  const auto steps = [&] {
    const GaitResult found = FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    return static_cast<std::size_t>(found.execution->steps);
  };
  request.seeks_most_margin = true;
  // Equal ratings: the margin decides.
  std::set<std::size_t> sizes;  // numbers of steps of all candidates
  request.rate = [&](const plan::Plan& plan, int, const Deadline&) {
    sizes.insert(plan.steps.size());
    return std::optional(planning::RobustnessRating{.conditions = 100});
  };
  const std::size_t shortest = steps();
  EXPECT_EQ(shortest, *sizes.begin());
  ASSERT_GT(sizes.size(), 1U);
  const std::size_t longest = *sizes.rbegin();
  request.rate = [&](const plan::Plan& plan, int most_failures,
                     const Deadline&) -> std::optional<planning::RobustnessRating> {
    planning::RobustnessRating rating{.conditions = 100};
    rating.failed.resize(longest - plan.steps.size());
    if (std::ssize(rating.failed) > most_failures) return std::nullopt;
    return rating;
  };
  for (const int jobs : {1, 4}) {
    request.jobs = jobs;
    EXPECT_EQ(steps(), longest) << jobs;
  }
  // Without ratings the margin decides.
  request.rate = [](const plan::Plan&, int, const Deadline&) {
    return std::optional<planning::RobustnessRating>();
  };
  EXPECT_EQ(steps(), shortest);
}

TEST(ScheduleTest, NoPlanIsSimulatedTwice) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  FakeHand hand{.executes = [](const plan::Plan&, std::size_t) { return false; }};
  hand.SimulateIn(request);
  request.robustness = RobustnessLevel::kRequired;
  request.most_expanded = 60;
  static_cast<void>(FindGait(request));
  ASSERT_GT(hand.plans.size(), 3U);
  std::set<std::string> different;
  for (const plan::Plan& plan : hand.plans) different.insert(plan::FormatPlan(plan));
  EXPECT_EQ(different.size(), hand.plans.size());
}

TEST(ScheduleTest, IfNoPlanExecutesAGaitIsFoundUnlessRobustnessIsRequired) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  FakeHand hand{.executes = {}, .initial_grasp_holds = false};
  hand.SimulateIn(request);
  request.most_expanded = 60;
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait);
  EXPECT_FALSE(ExecutesInSimulation(found));
  EXPECT_GT(hand.plans.size(), 3U);
  const auto slides = [](const plan::Plan& plan) {
    return std::ranges::count(plan.steps, std::string("align"), plan::StepKind) > 0;
  };
  EXPECT_EQ(std::ranges::count_if(hand.plans, slides), 0);
  request.robustness = RobustnessLevel::kRequired;
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  EXPECT_FALSE(ExecutesInSimulation(none));
  EXPECT_THAT(none.message, testing::HasSubstr("none executes in simulation"));
  EXPECT_THAT(none.message,
              testing::HasSubstr("fails at the initial grasp (slipped): finger 7 slipped"));
  request.robustness = RobustnessLevel::kNone;
  hand.plans.clear();
  EXPECT_TRUE(FindGait(request).gait);
  EXPECT_TRUE(hand.plans.empty());
}

TEST(ScheduleTest, ReportsTheFailureOfThePlanThatExecutesFarthest) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  request.robustness = RobustnessLevel::kRequired;
  request.most_expanded = 40;
  // Every second plan executes halfway, the others not at all.
  FakeHand hand;
  hand.executes = [&](const plan::Plan& simulated, std::size_t i) {
    return hand.plans.size() % 2 == 0 && i < simulated.steps.size() / 2;
  };
  hand.SimulateIn(request);
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  const std::string last_words = "finger 7 slipped, plan ";
  const std::size_t at = none.message.find(last_words);
  ASSERT_NE(at, std::string::npos) << none.message;
  const std::size_t named = std::stoul(none.message.substr(at + last_words.size()));
  EXPECT_EQ(named % 2, 0U);
  const std::size_t steps = hand.plans.at(named - 1).steps.size();
  ASSERT_GE(steps, 2U);
  EXPECT_THAT(none.message, testing::HasSubstr("fails at step " + std::to_string(steps / 2 + 1) +
                                               " of " + std::to_string(steps) + " (slipped)"));
  ASSERT_TRUE(none.execution);
  EXPECT_EQ(none.execution->reason, plan::Reason::kSlipped);
}

TEST(ScheduleTest, TheReasonIsThatOfTheSearchThatReachesFarthest) {
  GaitRequest request = RequestFor("cube", 0.8, 90);
  request.robustness = RobustnessLevel::kRequired;
  request.simulate = [](const plan::Plan&, const Deadline&) { return planning::ExecutionResult(); };
  int searches = 0;
  const FindOne find = [&](const GaitRequest& asked, std::span<const RobustnessMargins>) {
    if (!asked.simulate) return FoundGait{std::nullopt, "complete gait", 1};
    const int index = searches++;
    return FoundGait{std::nullopt, "search " + std::to_string(index), index == 1 ? 0.7 : 0.4};
  };
  EXPECT_EQ(FindExecutableGait(request, {}, find).found.message, "search 1");
  EXPECT_GT(searches, 2);
}

TEST(ScheduleTest, FailedEdgesAreCountedByReason) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  request.robustness = RobustnessLevel::kRequired;
  request.most_expanded = 10;
  FakeHand hand{.executes = [](const plan::Plan&, std::size_t) { return false; }};
  hand.SimulateIn(request);
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  EXPECT_FALSE(none.execution);
  EXPECT_THAT(none.message,
              testing::ContainsRegex("whose simulated execution fails .slipped [1-9]"));
}

TEST(ScheduleTest, WithoutASimulationResultTheSearchRunsWithoutSimulation) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  const GaitResult usual = FindGait(request);
  request.simulate = [](const plan::Plan&, const Deadline&) { return std::nullopt; };
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(usual.gait && found.gait);
  EXPECT_FALSE(found.execution);
  EXPECT_EQ(plan::FormatPlan(PlanOf(*found.gait, request, found.contacts)),
            plan::FormatPlan(PlanOf(*usual.gait, request, usual.contacts)));
}

}  // namespace schedule_test
}  // namespace regrasp::gait
