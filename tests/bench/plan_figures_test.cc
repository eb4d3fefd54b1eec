#include "bench/plan_figures.h"

#include <gtest/gtest.h>

namespace regrasp {
namespace {

FingerContact At(int finger, double x, double y) {
  return {finger, {{x, y, 0}, Eigen::Vector3d::UnitX(), 0}};
}

/// Finger 2 comes 3 from finger 0 and 5 from finger 1, which both leave in time; then two fingers
/// move by 1 and 2, and back by 1.
Plan SomePlan() {
  Plan plan;
  plan.initial = {At(0, 0, 0), At(1, 8, 0)};
  plan.steps = {
      Switch{{At(2, 3, 0)}, {0}},
      Align{{{At(1, 8, 0), At(2, 3, 0)}, {At(2, 4, 0), At(1, 8, 2)}, {At(1, 8, 2), At(2, 3, 0)}}},
      Switch{{At(0, 3, 6)}, {}}, Switch{{}, {2}}};
  return plan;
}

TEST(PlanFigures, TravelIsTheWayOfAlignsAndFromTheNearestReleasedContact) {
  EXPECT_DOUBLE_EQ(TravelOf(SomePlan()), 3 + (1 + 2) + 1);
  Plan both = SomePlan();
  both.steps = {Switch{{At(2, 5, 0), At(3, 1, 0)}, {0, 1}}};
  EXPECT_DOUBLE_EQ(TravelOf(both), 3 + 1);
}

TEST(PlanFigures, TravelGrowsWithTheUnitOfLength) {
  Plan plan = SomePlan();
  const double before = TravelOf(plan);
  constexpr double kScale = 1000;
  const auto grow = [&](FingerGrasp& grasp) {
    for (FingerContact& held : grasp) held.contact.p *= kScale;
  };
  grow(plan.initial);
  for (Step& step : plan.steps) {
    if (auto* change = std::get_if<Switch>(&step)) {
      grow(change->place);
      continue;
    }
    for (FingerGrasp& waypoint : std::get<Align>(step).waypoints) grow(waypoint);
  }
  EXPECT_DOUBLE_EQ(TravelOf(plan), kScale * before);
}

TEST(PlanFigures, APlanWithoutStepsHasNoWayAndNoAligns) {
  Plan plan = SomePlan();
  EXPECT_EQ(CountAligns(plan), 1);
  plan.steps.clear();
  EXPECT_EQ(CountAligns(plan), 0);
  EXPECT_EQ(TravelOf(plan), 0);
}

}  // namespace
}  // namespace regrasp
