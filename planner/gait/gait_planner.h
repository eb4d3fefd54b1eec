#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/planning/in_hand_task.h"
#include "planner/planning/planner.h"

namespace regrasp::gait {

struct GaitRequest;

/// Parameters of the planner `gait` in PlanRequest::parameters, in addition to SearchParameters.
struct GaitParameters {
  std::optional<planning::InHandTask> task = {};  ///< required; set by AskInHand

  [[nodiscard]] std::vector<std::string> Options() const {
    if (!task) return {};
    return {planning::kHandOption};
  }
};

/// Find single changes of an infeasible request that make a gait possible.
/// For each of friction, object size and palm tilt (the last only if no pose is given), the
/// smallest change with a gait is reported. Each probe may expand a twentieth of the request's
/// budget, so an unreported change may still help. All probes share the deadline; progress is
/// reported as in FindGait.
/// @returns text, for example "any one of these changes yields a plan: a friction of 0.96 instead
///     of 0.8; no effect: a tilt of the palm".
[[nodiscard]] std::string ExplainGait(const GaitRequest& request);

/// The planner `gait`: a hand rotates or translates the object, or changes its grasp.
/// Plans consist of in-hand motions, finger switches and sliding steps with certified finger paths
/// (FindGait). Start and goal grasps are optional.
/// A failure does not prove infeasibility; the message reports counted reasons.
class GaitPlanner final : public planning::Planner {
 public:
  GaitPlanner();
  [[nodiscard]] planning::PlanResult Plan(const planning::PlanRequest& request) const override;
};

/// Turn a plan request into a request for planning in a hand.
/// Sets the task and the hand used by the grasp criteria; the planner chooses start and goal grasp.
/// Without rotation and goal pose, the object keeps the given start pose.
void AskInHand(const planning::InHandTask& task, planning::PlanRequest& request);

}  // namespace regrasp::gait
