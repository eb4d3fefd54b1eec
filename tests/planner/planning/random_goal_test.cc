#include <gtest/gtest.h>

#include <vector>

#include "planner/base/deadline.h"
#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {
namespace random_goal_test {

PlanResult Found(double margin, bool warned) {
  PlanResult result;
  result.plan.emplace();
  result.margin = margin;
  if (warned) result.warnings = {"weak"};
  return result;
}

PlanResult None(const std::string& message) {
  PlanResult result;
  result.status = PlanResult::Status::kNoSequence;
  result.message = message;
  return result;
}

/// Return the result of draws that get consecutive numbers from 1, and the number of draws.
template <class Draw>
std::pair<PlanResult, int> Plan(const Draw& draw) {
  int draws = 0;
  PlanResult result = PlanToRandomGoal([&](bool last) {
    ++draws;
    EXPECT_EQ(last, draws == kGoalDraws);
    return draw(draws);
  });
  return {result, draws};
}

TEST(PlanToRandomGoal, TakesTheFirstPlanWithoutAWarning) {
  const auto [result, draws] = Plan([](int draw) { return Found(draw, draw < 4); });
  EXPECT_EQ(result.margin, 4);
  EXPECT_EQ(draws, 4);
}

TEST(PlanToRandomGoal, TakesTheFirstOfAllWhereEveryOneIsWarnedOf) {
  const auto [result, draws] = Plan([](int draw) { return Found(draw, true); });
  EXPECT_EQ(result.margin, 1);
  EXPECT_EQ(draws, kGoalDraws);
}

TEST(PlanToRandomGoal, GoesOnWhereOneHasNoPlan) {
  const auto [result, draws] =
      Plan([](int draw) { return draw < 3 ? None("draw") : Found(draw, false); });
  EXPECT_EQ(result.margin, 3);
  EXPECT_EQ(draws, 3);
}

TEST(PlanToRandomGoal, SaysWhatTheFirstDrawSaidWhereNoneHasAPlan) {
  const auto [result, draws] = Plan([](int draw) { return None("draw " + std::to_string(draw)); });
  EXPECT_FALSE(result.plan.has_value());
  EXPECT_EQ(result.message, "draw 1");
}

TEST(PlanToRandomGoal, KeepsTheFirstWhereTheTimeIsUpForOthersAndEndsWhereThereIsNone) {
  const auto at = [](int end) {
    return [end](int draw) {
      if (draw == end) throw TimeUp();
      return Found(draw, true);
    };
  };
  const auto [result, draws] = Plan(at(3));
  EXPECT_EQ(result.margin, 1);
  EXPECT_EQ(draws, 3);
  EXPECT_THROW((void)Plan(at(1)), TimeUp);
}

}  // namespace random_goal_test
}  // namespace regrasp::planning
