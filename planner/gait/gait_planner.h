#pragma once

#include <cstdint>

#include "planner/gait/find_gait.h"
#include "planner/planning/planner.h"

namespace regrasp::gait {

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
