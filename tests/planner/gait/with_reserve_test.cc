#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "planner/gait/plan_of_gait.h"
#include "planner/gait/rolling.h"
#include "planner/gait/schedule.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan_io.h"
#include "planner/plan/reason.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace with_reserve_test {

using Eigen::Vector3d;

/// What forces that hold the object's weight have to spare where balls roll, the least all along a
/// gait's moves, seen by keyframes.
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
  for (const PlanSegment& stretch : gait.segments) {
    if (stretch.kind == PlanSegment::Kind::kPlace) take(stretch.finger, stretch.contact);
    if (stretch.kind == PlanSegment::Kind::kRelease) rolled[stretch.finger].reset();
    if (stretch.kind != PlanSegment::Kind::kMove) continue;
    for (std::size_t i = 1; i < stretch.path.size(); ++i) {
      grasp::Grasp grasp;
      for (FingerIndex f{0}; f < std::ssize(rolled); ++f) {
        if (!rolled[f]) continue;
        const kinematics::Finger& chain = request.hand->fingers[f];
        const auto ball = [&](const Keyframe& at) {
          return FingertipOrientation(chain, at.postures[f], at.pose);
        };
        rolled[f] = Rolled(*rolled[f], ball(stretch.path[i]) * ball(stretch.path[i - 1]).inverse(),
                           chain.tip.radius, surface);
        grasp.push_back({rolled[f]->p / request.scale, rolled[f]->n, {}});
      }
      const Vector3d weight = -(stretch.path[i].pose.linear().transpose() * request.hand->up);
      least = std::min(least,
                       grasp::ComputeGraspForces(grasp, frame, request.criteria.half_angle,
                                                 {weight, Vector3d::Zero()}, kGraspForceOverWeight)
                           .margin);
    }
  }
  return least;
}

TEST(WithReserveTest, GraspsOfAGaitWithReserveHoldWhereTheirContactsRollTo) {
  double worst_without = 1;
  for (int seed = 1; seed <= 4; ++seed) {
    GaitRequest request = RequestFor("cube", 0.8, 90);
    request.seed = seed;
    request.reserve = Reserve::kRequired;
    const GaitResult with = FindGait(request);
    ASSERT_TRUE(with.gait) << with.message;
    // Followed at poses of the grid: between them a little less.
    EXPECT_GT(ForceMarginWhereItRolls(*with.gait, request, with.contacts), 0.15);
    for (const PlanSegment& stretch : with.gait->segments) {
      EXPECT_NE(stretch.kind, PlanSegment::Kind::kSlide);
    }
    request.reserve = Reserve::kNone;
    const GaitResult without = FindGait(request);
    ASSERT_TRUE(without.gait);
    worst_without =
        std::min(worst_without, ForceMarginWhereItRolls(*without.gait, request, without.contacts));
  }
  EXPECT_LT(worst_without, 0);
}

TEST(WithReserveTest, WhereNothingIsToSpareARequiredReserveIsToldOf) {
  GaitRequest request = RequestFor("cube", 0.8, 90);
  request.criteria.half_angle = std::atan(0.15);
  request.reserve = Reserve::kRequired;
  request.most_expanded = 60;
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::HasSubstr("without reserve there may be a plan"));
}

/// Fails where there is no trial.
bool ExecutesInSimulation(const GaitResult& result) {
  EXPECT_TRUE(result.trial) << result.message;
  return result.trial && result.trial->is_whole;
}

/// A hand that was made up: what it is asked to carry out, and how far it does.
struct MadeUpHand {
  /// Whether it carries out a step of a plan, by number; all before it were.
  std::function<bool(const plan::Plan&, std::size_t)> carries_out;
  bool holds = true;
  std::vector<plan::Plan> plans = {};

  void TriesFor(GaitRequest& request) {
    request.carry_out = [this](const plan::Plan& plan, const Deadline&) {
      plans.push_back(plan);
      planning::CarriedOut carried{holds, 0, false};
      carried.reason = plan::Reason::kSlipped;
      carried.detail = "finger 7 slipped, plan " + std::to_string(plans.size());
      if (!holds) return std::optional(carried);
      while (carried.steps < std::ssize(plan.steps) && carries_out(plan, carried.steps)) {
        ++carried.steps;
      }
      carried.is_whole = carried.steps == std::ssize(plan.steps);
      return std::optional(carried);
    };
  }
};

bool Places(const plan::Step& step, FingerIndex finger) {
  const auto* change = std::get_if<plan::Switch>(&step);
  return change != nullptr && std::ranges::any_of(change->place, [&](const auto& placed) {
           return placed.finger == finger;
         });
}

/// By how much the object turns in a move, radians.
double TurnIn(const plan::Step& step) {
  const auto* move = std::get_if<plan::Move>(&step);
  if (move == nullptr) return 0;
  const Eigen::Matrix3d turn =
      move->path.front().pose.linear().transpose() * move->path.back().pose.linear();
  return Eigen::AngleAxisd(turn).angle();
}

TEST(WithReserveTest, WhatIsFoundIsWhatTheHandCarriesOutAsItWasTried) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  // A finger that is placed otherwise, and never where that is not carried out.
  FingerIndex never_placed;
  const auto places = [&](const plan::Step& step) { return Places(step, never_placed); };
  const auto is_placed = [&] {
    const GaitResult usual = FindGait(request);
    if (!usual.gait) return false;
    const plan::Plan plan = PlanOf(*usual.gait, request, usual.contacts);
    for (never_placed = FingerIndex{0}; never_placed < std::ssize(request.hand->fingers);
         ++never_placed) {
      if (std::ranges::any_of(plan.steps, places)) return true;
    }
    return false;
  };
  while (!is_placed()) ASSERT_LT(++request.seed, 10);
  MadeUpHand hand{.carries_out = [&](const plan::Plan& tried, std::size_t i) {
    return !places(tried.steps[i]);
  }};
  hand.TriesFor(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  const plan::Plan carried = PlanOf(*found.gait, request, found.contacts);
  EXPECT_FALSE(std::ranges::any_of(carried.steps, places));
  EXPECT_EQ(plan::FormatPlan(carried), plan::FormatPlan(hand.plans.back()));
}

TEST(WithReserveTest, WhereMovesFailHalfWayFingersAreSwitchedSooner) {
  constexpr double kMostTurn = 0.3;
  GaitRequest request = RequestFor("cube", 0.8, 90);
  MadeUpHand hand{.carries_out = [&](const plan::Plan& tried, std::size_t i) {
    return TurnIn(tried.steps[i]) <= kMostTurn;
  }};
  hand.TriesFor(request);
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
  double most = 0;
  for (const plan::Step& step : plan.steps) most = std::max(most, TurnIn(step));
  EXPECT_LE(most, kMostTurn);
  request.carry_out = nullptr;
  const GaitResult usual = FindGait(request);
  ASSERT_TRUE(usual.gait);
  most = 0;
  for (const plan::Step& step : PlanOf(*usual.gait, request, usual.contacts).steps) {
    most = std::max(most, TurnIn(step));
  }
  EXPECT_GT(most, kMostTurn);
}

/// What a made-up hand has to spare depends on how many steps a plan has.
TEST(WithReserveTest, OfTheGaitsThatAreCarriedOutTheOneWithMostToSpareIsFoundWhereThatIsSought) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  std::vector<std::string> plans;
  const auto spare = [](const plan::Plan& plan) {
    return 1.0 / static_cast<double>(2 + (7 * plan.steps.size()) % 5);
  };
  double most = 0;
  request.carry_out = [&](const plan::Plan& plan, const Deadline&) {
    const int steps = static_cast<int>(plan.steps.size());
    plans.push_back(plan::FormatPlan(plan));
    most = std::max(most, spare(plan));
    return std::optional(planning::CarriedOut{true, steps, true, spare(plan)});
  };
  const auto find = [&] {
    plans.clear();
    most = 0;
    const GaitResult found = FindGait(request);
    EXPECT_TRUE(found.gait) << found.message;
    EXPECT_TRUE(ExecutesInSimulation(found));
    const plan::Plan plan = PlanOf(*found.gait, request, found.contacts);
    EXPECT_EQ(found.trial->spare, spare(plan));
    return plan;
  };
  const plan::Plan first = find();
  EXPECT_EQ(plan::FormatPlan(first), plans.back());
  request.seeks_most_margin = true;
  const plan::Plan best = find();
  EXPECT_GT(plans.size(), 1U);
  EXPECT_NE(plan::FormatPlan(best), plans.back());
  EXPECT_EQ(spare(best), most);
}

TEST(WithReserveTest, NothingIsTriedTwice) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  MadeUpHand hand{.carries_out = [](const plan::Plan&, std::size_t) { return false; }};
  hand.TriesFor(request);
  request.reserve = Reserve::kRequired;
  request.most_expanded = 60;
  static_cast<void>(FindGait(request));
  ASSERT_GT(hand.plans.size(), 3U);
  std::set<std::string> different;
  for (const plan::Plan& plan : hand.plans) different.insert(plan::FormatPlan(plan));
  EXPECT_EQ(different.size(), hand.plans.size());
}

TEST(WithReserveTest, WhereTheHandHoldsNothingThereIsAGaitUnlessThatIsRequired) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  MadeUpHand hand{.carries_out = {}, .holds = false};
  hand.TriesFor(request);
  request.most_expanded = 60;
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait);
  EXPECT_FALSE(ExecutesInSimulation(found));
  EXPECT_GT(hand.plans.size(), 3U);
  const auto slides = [](const plan::Plan& plan) {
    return std::ranges::count(plan.steps, std::string("align"), plan::StepKind) > 0;
  };
  EXPECT_EQ(std::ranges::count_if(hand.plans, slides), 0);
  request.reserve = Reserve::kRequired;
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  EXPECT_FALSE(ExecutesInSimulation(none));
  EXPECT_THAT(none.message, testing::HasSubstr("motors carry none out"));
  EXPECT_THAT(none.message, testing::HasSubstr("the first hold fails (slipped): finger 7 slipped"));
  request.reserve = Reserve::kNone;
  hand.plans.clear();
  EXPECT_TRUE(FindGait(request).gait);
  EXPECT_TRUE(hand.plans.empty());
}

TEST(WithReserveTest, OfWhatIsNotCarriedOutThePlanIsNamedThatComesFarthest) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  request.reserve = Reserve::kRequired;
  request.most_expanded = 40;
  // Of every second plan half, and nothing of the others.
  MadeUpHand hand;
  hand.carries_out = [&](const plan::Plan& tried, std::size_t i) {
    return hand.plans.size() % 2 == 0 && i < tried.steps.size() / 2;
  };
  hand.TriesFor(request);
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  const std::string last_words = "finger 7 slipped, plan ";
  const std::size_t at = none.message.find(last_words);
  ASSERT_NE(at, std::string::npos) << none.message;
  const std::size_t named = std::stoul(none.message.substr(at + last_words.size()));
  EXPECT_EQ(named % 2, 0U);
  const std::size_t steps = hand.plans.at(named - 1).steps.size();
  ASSERT_GE(steps, 2U);
  EXPECT_THAT(none.message, testing::HasSubstr("step " + std::to_string(steps / 2 + 1) + " of " +
                                               std::to_string(steps) + " fails (slipped)"));
  ASSERT_TRUE(none.trial);
  EXPECT_EQ(none.trial->reason, plan::Reason::kSlipped);
}

TEST(WithReserveTest, WhatFailsOnTheWayToNoGaitIsCountedByItsReason) {
  GaitRequest request = RequestFor("cube", 0.8, 180);
  request.reserve = Reserve::kRequired;
  request.most_expanded = 10;
  MadeUpHand hand{.carries_out = [](const plan::Plan&, std::size_t) { return false; }};
  hand.TriesFor(request);
  const GaitResult none = FindGait(request);
  EXPECT_FALSE(none.gait);
  EXPECT_FALSE(none.trial);
  EXPECT_THAT(none.message, testing::ContainsRegex("motors do not come .slipped [1-9]"));
}

/// A clock that is set by hand.
TEST(WithReserveTest, WhereTheTimeIsUpInATrialItIsNotSaidThatTheHandDoesNotCarryItOut) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  Deadline::Clock::time_point now;
  request.deadline = {now + std::chrono::seconds(10), [&] { return now; }};
  int trials = 0;
  request.carry_out = [&](const plan::Plan&, const Deadline& deadline) {
    ++trials;
    now += std::chrono::seconds(20);
    EXPECT_TRUE(deadline.IsOver());
    return std::optional(planning::CarriedOut{.is_held = true, .is_cut_short = true});
  };
  const GaitResult cut_short = FindGait(request);
  ASSERT_TRUE(cut_short.gait) << cut_short.message;
  EXPECT_TRUE(cut_short.trial->is_cut_short);
  EXPECT_FALSE(ExecutesInSimulation(cut_short));
  EXPECT_EQ(trials, 1);

  now = {};
  request.carry_out = [&](const plan::Plan&, const Deadline&) {
    now += std::chrono::seconds(20);
    return std::optional(planning::CarriedOut{.is_held = true});
  };
  const GaitResult failed = FindGait(request);
  ASSERT_TRUE(failed.gait) << failed.message;
  EXPECT_FALSE(failed.trial->is_cut_short);
  EXPECT_FALSE(ExecutesInSimulation(failed));
}

/// A hand that carries out one of so many plans, whichever.
std::function<std::optional<planning::CarriedOut>(const plan::Plan&, const Deadline&)> OneOf(
    std::size_t many, std::atomic<int>& trials) {
  return [many, &trials](const plan::Plan& plan, const Deadline&) {
    ++trials;
    const bool is_carried = std::hash<std::string>()(plan::FormatPlan(plan)) % many == 0;
    return std::optional(planning::CarriedOut{
        true, is_carried ? static_cast<int>(plan.steps.size()) : 0, is_carried, 0.5});
  };
}

TEST(WithReserveTest, WithAnyJobsTheGaitIsTheSameWithoutADeadline) {
  // More than the first row makes: a whole gait is tried four times at most.
  constexpr int kOfFirstRow = 4;
  int found_later = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    GaitRequest request = RequestFor("cube", 0.8, 60);
    request.seed = seed;
    request.most_expanded = 200;
    const auto find = [&](int jobs, int& tried) {
      std::atomic<int> trials = 0;
      request.jobs = jobs;
      request.carry_out = OneOf(4, trials);
      const GaitResult found = FindGait(request);
      tried = trials;
      return found;
    };
    int trials_alone = 0;
    int trials_together = 0;
    const GaitResult alone = find(1, trials_alone);
    const GaitResult together = find(3, trials_together);
    ASSERT_EQ(alone.gait.has_value(), together.gait.has_value());
    EXPECT_EQ(ExecutesInSimulation(alone), ExecutesInSimulation(together));
    EXPECT_EQ(alone.message, together.message);
    if (!alone.gait) continue;
    EXPECT_EQ(plan::FormatPlan(PlanOf(*alone.gait, request, alone.contacts)),
              plan::FormatPlan(PlanOf(*together.gait, request, together.contacts)));
    EXPECT_GE(trials_together, trials_alone);
    if (ExecutesInSimulation(alone) && trials_alone > kOfFirstRow) {
      ++found_later;
    };
  }
  EXPECT_GT(found_later, 0);
}

TEST(WithReserveTest, WhatIsThrownInOneOfSeveralSearchesEndsThemAll) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  request.jobs = 3;
  request.deadline = DeadlineAfter(Deadline::Clock::now(), 3600);
  std::atomic<int> trials = 0;
  request.carry_out = [&](const plan::Plan&, const Deadline&) {
    if (++trials == 5) throw std::runtime_error("the fifth");
    return std::optional(planning::CarriedOut{.is_held = true});
  };
  EXPECT_THROW(static_cast<void>(FindGait(request)), std::runtime_error);
  EXPECT_GE(trials, 5);
}

TEST(WithReserveTest, WithADeadlineTheFirstSearchThatEndsInAGaitEndsThemAll) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  request.jobs = 3;
  Deadline::Clock::time_point now;
  request.deadline = {now + std::chrono::seconds(10), [&] { return now; }};
  std::mutex mutex;
  std::optional<std::thread::id> first;
  // All but the first thread that asks wait in their trials until they are given up, which is at
  // once; without an end they would wait for ever where they are not.
  constexpr std::chrono::minutes kForEver(2);
  std::atomic<bool> is_given_up = true;
  request.carry_out = [&](const plan::Plan& plan, const Deadline& deadline) {
    bool is_first = false;
    {
      const std::scoped_lock lock(mutex);
      is_first = first.value_or(std::this_thread::get_id()) == std::this_thread::get_id();
      first = first.value_or(std::this_thread::get_id());
    }
    const auto until = std::chrono::steady_clock::now() + kForEver;
    while (!is_first && !deadline.IsOver() && is_given_up) {
      is_given_up = std::chrono::steady_clock::now() < until;
      std::this_thread::yield();
    }
    return std::optional(planning::CarriedOut{.is_held = true,
                                              .steps = static_cast<int>(plan.steps.size()),
                                              .is_whole = is_first,
                                              .spare = 0.5,
                                              .is_cut_short = !is_first});
  };
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  EXPECT_TRUE(is_given_up);
}

TEST(WithReserveTest, WhereItCanNotBeToldItIsAsIfTheHandWereNotAsked) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  const GaitResult usual = FindGait(request);
  request.carry_out = [](const plan::Plan&, const Deadline&) { return std::nullopt; };
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(usual.gait && found.gait);
  EXPECT_FALSE(found.trial);
  EXPECT_EQ(plan::FormatPlan(PlanOf(*found.gait, request, found.contacts)),
            plan::FormatPlan(PlanOf(*usual.gait, request, usual.contacts)));
}

}  // namespace with_reserve_test
}  // namespace regrasp::gait
