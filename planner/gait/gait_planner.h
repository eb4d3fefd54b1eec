#pragma once

#include <cstdint>
#include <string>

#include "planner/gait/request.h"
#include "planner/planning/planner.h"

namespace regrasp::gait {

/// Of a request for which no gait was found: the smallest of some changes with which one is found,
/// in friction, in the size of the object and in the tilt of the palm (where no pose is given),
/// each alone.
///
/// Each change is tried with a twentieth of the grasps that the request may expand, so that what is
/// not named may help none the less. The deadline is of all tries together; progress as in
/// FindGait.
/// @returns as in "would do: a friction of 0.96 instead of 0.8; the object 0.8 times as large", or
///          what was tried in vain.
[[nodiscard]] std::string ExplainGait(const GaitRequest& request);

/// The planner `gait`: a hand turns an object, carries it or changes its grasp, with moves,
/// switches and aligns, all fingers' ways free and certified (FindGait). Start and goal grasps may
/// be any.
///
/// Failure is not a proof of infeasibility: the message says what stopped it, counted.
class GaitPlanner final : public planning::Planner {
 public:
  GaitPlanner();
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
};

/// Asks for a plan in a hand: sets the task and the fingers that grasps are judged for, and has the
/// planner choose start and goal grasp. Without turn and goal pose the object stays at its start
/// pose, if that is given.
void AskInHand(const planning::InHandTask& task, planning::PlanRequest& request);

}  // namespace regrasp::gait
