#include "planner/planning/candidate_result.h"

#include <utility>

#include "planner/base/number.h"
#include "planner/planning/rest_summary.h"

namespace regrasp::planning {

std::optional<plan::PlanObstacle> FindObstacle(const CandidateSequence& candidate,
                                               const criteria::GraspEvaluator& evaluator) {
  return plan::FindPlanObstacle(evaluator.object(), candidate.initial, candidate.steps,
                                evaluator.finger_radius());
}

PlanResult ResultOf(const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator,
                    const std::string& planner, const PlanRequest& request,
                    const grasp::Grasp& goal) {
  PlanResult result;
  if (const auto obstacle = FindObstacle(candidate, evaluator)) {
    result.status = PlanResult::Status::kNoSequence;
    result.message = "the planner " + planner + " found no sequence for fingers of radius " +
                     FormatShort(evaluator.finger_radius()) + "; in the best one, step " +
                     std::to_string(obstacle->index) + ": " + obstacle->detail;
    return result;
  }
  plan::Plan& plan = result.plan.emplace();
  plan.dimension = request.object->dimension();
  plan.half_angle = request.criteria.half_angle;
  plan.fingers = request.hand.fingers;
  plan.torsion = request.hand.torsion;
  plan.planner = planner;
  if (request.hand.fingertip_radius > 0) plan.finger_radius = request.hand.fingertip_radius;
  plan.initial = candidate.initial;
  plan.steps = candidate.steps;
  plan.goal = goal;
  result.margin = SmallestMargin(candidate.rests, evaluator);
  result.warnings = RestWarnings(candidate.rests, evaluator);
  return result;
}

}  // namespace regrasp::planning
