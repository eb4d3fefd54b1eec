#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "planner/planning/plan_result.h"
#include "tests/planner/counted_deadline.h"

namespace regrasp {

/// Law: work that looks so often at its deadline ends by TimeUp at the look at which that comes,
/// and looks no more.
inline void ExpectEndsWhereverItComes(int looks,
                                      const std::function<void(const Deadline& deadline)>& work) {
  for (int look = 1; look <= looks; look += 1 + look / 10) {
    const CountedDeadline counted(look);
    EXPECT_THROW(work(counted.deadline()), TimeUp) << look;
    EXPECT_EQ(counted.looks(), look);
  }
}

/// Law: a planner that finds a plan without a deadline says, wherever one comes, that its time was
/// up; or it has a plan already and only looked for a better one.
/// @param least_ended  so many of the looks that are tried leave no plan, or more.
inline void ExpectPlanEndsWhereverItComes(
    const std::string& planner, int least_ended,
    const std::function<PlanResult(const Deadline& deadline)>& plan) {
  const CountedDeadline never;
  ASSERT_TRUE(plan(never.deadline()).plan);
  int ended = 0;
  for (int look = 1; look <= never.looks(); look += 1 + look / 5) {
    const PlanResult result = plan(CountedDeadline(look).deadline());
    if (result.plan) continue;
    EXPECT_THAT(result.message,
                ::testing::HasSubstr("the planner " + planner + " when the time was up"));
    ++ended;
  }
  EXPECT_GE(ended, least_ended);
}

}  // namespace regrasp
