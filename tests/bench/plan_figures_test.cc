#include "bench/plan_figures.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace plan_figures_test {

plan::FingerContact At(int finger, double x, double y) {
  return {FingerIndex(finger), {{x, y, 0}, Eigen::Vector3d::UnitX(), FaceIndex(0)}};
}

/// Finger 2 is placed at a distance of 3 from finger 0 and 5 from finger 1, which are both
/// released. Then two fingers move by 1 and 2, and back by 1.
plan::Plan SomePlan() {
  plan::Plan plan;
  plan.initial = {At(0, 0, 0), At(1, 8, 0)};
  plan.steps = {
      plan::Switch{{At(2, 3, 0)}, {FingerIndex(0)}},
      plan::Align{
          {{At(1, 8, 0), At(2, 3, 0)}, {At(2, 4, 0), At(1, 8, 2)}, {At(1, 8, 2), At(2, 3, 0)}}},
      plan::Switch{{At(0, 3, 6)}, {}}, plan::Switch{{}, {FingerIndex(2)}}};
  return plan;
}

TEST(PlanFigures, TravelIsTheWayOfAlignsAndFromTheNearestReleasedContact) {
  EXPECT_DOUBLE_EQ(TravelOf(SomePlan()), 3 + (1 + 2) + 1);
  plan::Plan both = SomePlan();
  both.steps = {plan::Switch{{At(2, 5, 0), At(3, 1, 0)}, {FingerIndex(0), FingerIndex(1)}}};
  EXPECT_DOUBLE_EQ(TravelOf(both), 3 + 1);
}

TEST(PlanFigures, TravelGrowsWithTheUnitOfLength) {
  plan::Plan plan = SomePlan();
  const double before = TravelOf(plan);
  constexpr double kScale = 1000;
  const auto grow = [&](plan::FingerGrasp& grasp) {
    for (plan::FingerContact& held : grasp) held.contact.p *= kScale;
  };
  grow(plan.initial);
  for (plan::Step& step : plan.steps) {
    if (auto* change = std::get_if<plan::Switch>(&step)) {
      grow(change->place);
      continue;
    }
    for (plan::FingerGrasp& waypoint : std::get<plan::Align>(step).waypoints) grow(waypoint);
  }
  EXPECT_DOUBLE_EQ(TravelOf(plan), kScale * before);
}

TEST(PlanFigures, APlanWithoutStepsHasNoWayAndNoAligns) {
  plan::Plan plan = SomePlan();
  EXPECT_EQ(CountAligns(plan), 1);
  plan.steps.clear();
  EXPECT_EQ(CountAligns(plan), 0);
  EXPECT_EQ(TravelOf(plan), 0);
}

}  // namespace plan_figures_test
}  // namespace regrasp
