#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>

#include "planner/gait/failure_causes.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/schedule.h"
#include "planner/plan/plan_io.h"
#include "tests/planner/gait/gait_requests.h"

namespace regrasp::gait {
namespace search_limits_test {

struct PatientSearch {
  bool finds = false;
  std::int64_t expanded = 0;
};

/// Search a turn by 360° with little friction, until it stagnates for a number of stances.
PatientSearch SearchWith(std::int64_t patience) {
  GaitRequest request = RequestFor("cube", 0.8, 360);
  request.robustness = RobustnessLevel::kNone;
  request.criteria.friction_angle = Radians(6);
  request.patience = patience;
  PatientSearch search;
  request.progress = [&](std::string_view text) {
    std::istringstream in{std::string(text.substr(text.find(':') + 1))};
    std::int64_t count = 0;
    if (in >> count) search.expanded = count;
  };
  search.finds = FindGait(request).gait.has_value();
  return search;
}

TEST(SearchLimitsTest, ASearchThatStagnatesEnds) {
  const PatientSearch patient = SearchWith(400);
  EXPECT_TRUE(patient.finds);
  const PatientSearch hasty = SearchWith(20);
  EXPECT_FALSE(hasty.finds);
  EXPECT_GE(hasty.expanded, 20);
  EXPECT_LT(hasty.expanded, patient.expanded);
  const PatientSearch hastier = SearchWith(1);
  EXPECT_FALSE(hastier.finds);
  EXPECT_LT(hastier.expanded, hasty.expanded);
}

/// Uses a clock that is set by hand.
TEST(SearchLimitsTest, ASimulationCutShortByTheTimeLimitIsNotAFailure) {
  GaitRequest request = RequestFor("cube", 0.8, 120);
  Deadline::Clock::time_point now;
  request.deadline = {now + std::chrono::seconds(10), [&] { return now; }};
  int simulations = 0;
  request.simulate = [&](const plan::Plan&, const Deadline& deadline) {
    ++simulations;
    now += std::chrono::seconds(20);
    EXPECT_TRUE(deadline.IsOver());
    return std::optional(planning::ExecutionResult{.is_held = true, .is_cut_short = true});
  };
  const GaitResult cut_short = FindGait(request);
  ASSERT_TRUE(cut_short.gait) << cut_short.message;
  EXPECT_TRUE(cut_short.execution->is_cut_short);
  EXPECT_FALSE(ExecutesInSimulation(cut_short));
  EXPECT_EQ(simulations, 1);

  now = {};
  request.simulate = [&](const plan::Plan&, const Deadline&) {
    now += std::chrono::seconds(20);
    return std::optional(planning::ExecutionResult{.is_held = true});
  };
  const GaitResult failed = FindGait(request);
  ASSERT_TRUE(failed.gait) << failed.message;
  EXPECT_FALSE(failed.execution->is_cut_short);
  EXPECT_FALSE(ExecutesInSimulation(failed));
}

/// Simulated hand that executes one of `many` plans, selected by hash.
std::function<std::optional<planning::ExecutionResult>(const plan::Plan&, const Deadline&)> OneOf(
    std::size_t one_in, std::atomic<int>& simulations) {
  return [one_in, &simulations](const plan::Plan& plan, const Deadline&) {
    ++simulations;
    const bool executes = std::hash<std::string>()(plan::FormatPlan(plan)) % one_in == 0;
    return std::optional(planning::ExecutionResult{
        true, executes ? static_cast<int>(plan.steps.size()) : 0, executes, 0.5});
  };
}

TEST(SearchLimitsTest, WithoutADeadlineTheGaitDoesNotDependOnTheNumberOfJobs) {
  // Whole-gait attempts of the first schedule.
  constexpr int kWholeAttemptsOfFirst = 4;
  int found_later = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    GaitRequest request = RequestFor("cube", 0.8, 60);
    request.seed = seed;
    request.most_expanded = 200;
    const auto find = [&](int jobs, int& simulated) {
      std::atomic<int> simulations = 0;
      request.jobs = jobs;
      request.simulate = OneOf(4, simulations);
      const GaitResult found = FindGait(request);
      simulated = simulations;
      return found;
    };
    int simulations_alone = 0;
    int simulations_together = 0;
    const GaitResult alone = find(1, simulations_alone);
    const GaitResult together = find(3, simulations_together);
    ASSERT_EQ(alone.gait.has_value(), together.gait.has_value());
    EXPECT_EQ(ExecutesInSimulation(alone), ExecutesInSimulation(together));
    EXPECT_EQ(alone.message, together.message);
    if (!alone.gait) continue;
    EXPECT_EQ(plan::FormatPlan(PlanOf(*alone.gait, request, alone.contacts)),
              plan::FormatPlan(PlanOf(*together.gait, request, together.contacts)));
    EXPECT_GE(simulations_together, simulations_alone);
    if (ExecutesInSimulation(alone) && simulations_alone > kWholeAttemptsOfFirst) {
      ++found_later;
    };
  }
  EXPECT_GT(found_later, 0);
}

TEST(SearchLimitsTest, AnExceptionInOneSearchEndsAll) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  request.jobs = 3;
  request.deadline = DeadlineAfter(Deadline::Clock::now(), 3600);
  std::atomic<int> simulations = 0;
  request.simulate = [&](const plan::Plan&, const Deadline&) {
    if (++simulations == 5) throw std::runtime_error("the fifth");
    return std::optional(planning::ExecutionResult{.is_held = true});
  };
  EXPECT_THROW(static_cast<void>(FindGait(request)), std::runtime_error);
  EXPECT_GE(simulations, 5);
}

TEST(SearchLimitsTest, WithADeadlineTheFirstExecutingGaitEndsAllSearches) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  request.jobs = 3;
  Deadline::Clock::time_point now;
  request.deadline = {now + std::chrono::seconds(10), [&] { return now; }};
  std::mutex mutex;
  std::optional<std::thread::id> first;
  // All threads except the first simulate until they are abandoned, which happens at once. The
  // bound only prevents an endless wait if the test fails.
  constexpr std::chrono::minutes kForEver(2);
  std::atomic<bool> is_abandoned = true;
  request.simulate = [&](const plan::Plan& plan, const Deadline& deadline) {
    bool is_first = false;
    {
      const std::scoped_lock lock(mutex);
      is_first = first.value_or(std::this_thread::get_id()) == std::this_thread::get_id();
      first = first.value_or(std::this_thread::get_id());
    }
    const auto until = std::chrono::steady_clock::now() + kForEver;
    while (!is_first && !deadline.IsOver() && is_abandoned) {
      is_abandoned = std::chrono::steady_clock::now() < until;
      std::this_thread::yield();
    }
    return std::optional(planning::ExecutionResult{.is_held = true,
                                                   .steps = static_cast<int>(plan.steps.size()),
                                                   .is_whole = is_first,
                                                   .tolerance_margin = 0.5,
                                                   .is_cut_short = !is_first});
  };
  const GaitResult found = FindGait(request);
  ASSERT_TRUE(found.gait) << found.message;
  EXPECT_TRUE(ExecutesInSimulation(found));
  EXPECT_TRUE(is_abandoned);
}

/// Reached fractions of tracks with different numbers of steps are compared, not the steps.
TEST(SearchLimitsTest, FractionsOfDifferentTracksAreCompared) {
  GaitCounts near, far;
  std::tie(near.farthest, near.steps) = std::pair(27, 30);
  std::tie(far.farthest, far.steps) = std::pair(31, 76);
  EXPECT_DOUBLE_EQ(near.fraction(), 0.9);
  EXPECT_LT(far.fraction(), near.fraction());
  EXPECT_EQ(GaitCounts().fraction(), 1);
  SearchEvidence evidence;
  evidence.Add({far, near});
  EXPECT_DOUBLE_EQ(evidence.farthest, 0.9);
}

TEST(SearchLimitsTest, WithoutTimeNothingWasSearched) {
  GaitRequest request = RequestFor("cube", 0.8, 60);
  const Deadline::Clock::time_point now;
  request.deadline = {now, [=] { return now; }};
  const GaitResult found = FindGait(request);
  EXPECT_FALSE(found.gait);
  EXPECT_THAT(found.message, testing::StartsWith("no initial pose was searched"));
}

}  // namespace search_limits_test
}  // namespace regrasp::gait
