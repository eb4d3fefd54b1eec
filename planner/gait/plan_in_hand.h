#pragma once

#include <string>

#include "planner/gait/find_gait.h"
#include "planner/planning/plan_result.h"

namespace regrasp::gait {

/// FindGait as a planner answers: the plan, all but the object's file and digest, or why there is
/// none.
[[nodiscard]] planning::PlanResult PlanInHand(const GaitRequest& request);

/// @param name  of the grasp, in the message.
/// @throws InputError  the hand has fewer fingers than the grasp has contacts, or the grasp has
///                     fewer than three.
void CheckHandGrasp(const grasp::Grasp& grasp, const kinematics::HandModel& hand,
                    const std::string& name);

}  // namespace regrasp::gait
