#include "sim/hand/check_goals.h"

#include <cmath>
#include <cstdlib>

namespace regrasp::sim {

namespace {

constexpr double kGoalPlace = 1e-6;  // metres
constexpr double kGoalTurn = 1e-6;   // radians

}  // namespace

std::optional<HandFinding> CheckGoals(const plan::Plan& plan, int entry,
                                      const plan::HandState& state) {
  for (const plan::GoalMark& mark : plan.hand->goals) {
    if (mark.step != entry) continue;
    const plan::GoalDistance off = mark.set.Distance(state.pose);
    if (off.length > kGoalPlace || off.angle > kGoalTurn) return GoalSetMissed(state, mark);
  }
  if (entry == 0 || entry != std::ssize(plan.steps)) return std::nullopt;
  const Eigen::Isometry3d& goal = plan.hand->goal;
  const double length = (goal.translation() - state.pose.translation()).norm();
  const double turn =
      std::abs(Eigen::AngleAxisd(goal.linear().transpose() * state.pose.linear()).angle());
  if (length <= kGoalPlace && turn <= kGoalTurn) return std::nullopt;
  return GoalMissed(state, goal);
}

}  // namespace regrasp::sim
