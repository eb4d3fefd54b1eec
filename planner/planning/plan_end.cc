#include "planner/planning/plan_end.h"

#include <stdexcept>

namespace regrasp::planning {

HandEnd EndOfPlan(const plan::Plan& plan) {
  if (!plan.hand) throw std::invalid_argument("requires a plan for a hand");
  HandEnd end{plan.hand->initial, plan.initial};
  for (const plan::Step& step : plan.steps) {
    end.state = plan::StateAfter(end.state, step);
    end.grasp = plan::GraspAfter(end.grasp, step);
  }
  return end;
}

void StartFrom(const HandEnd& end, InHandTask& task) {
  task.start_pose = end.state.pose;
  task.start_joints = end.state.joints;
  task.start_fingers.clear();
  for (const plan::FingerContact& held : end.grasp) task.start_fingers.push_back(held.finger);
}

}  // namespace regrasp::planning
