#include "planner/gait/plan_in_hand.h"

#include "planner/base/error.h"
#include "planner/gait/plan_of_gait.h"

namespace regrasp::gait {

planning::PlanResult PlanInHand(const GaitRequest& request) {
  const GaitResult found = FindGait(request);
  planning::PlanResult result;
  if (!found.gait) {
    result.message = found.message;
    result.status = planning::PlanResult::Status::kNoSequence;
    return result;
  }
  result.plan = PlanOf(*found.gait, request, found.contacts);
  return result;
}

void CheckHandGrasp(const grasp::Grasp& grasp, const kinematics::HandModel& hand,
                    const std::string& name) {
  if (grasp.size() >= 3 && grasp.size() <= hand.fingers.size()) return;
  throw InputError(name + ": a grasp of this hand has 3 to " + std::to_string(hand.fingers.size()) +
                   " contacts, found " + std::to_string(grasp.size()));
}

}  // namespace regrasp::gait
