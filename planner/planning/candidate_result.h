#pragma once

#include <optional>
#include <string>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/plan/plan_reach.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/planning/plan_request.h"
#include "planner/planning/plan_result.h"

namespace regrasp::planning {

/// The first step that fingers of the evaluator's hand could not carry out.
[[nodiscard]] std::optional<plan::PlanObstacle> FindObstacle(
    const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator);

/// The answer that a sequence is: its plan, with its margin and a warning where a grasp does not
/// meet the criteria; none where fingers of the hand cannot carry it out.
/// @param request  its hand has as many fingers as the plan is for.
[[nodiscard]] PlanResult ResultOf(const CandidateSequence& candidate,
                                  const criteria::GraspEvaluator& evaluator,
                                  const std::string& planner, const PlanRequest& request,
                                  const grasp::Grasp& goal);

}  // namespace regrasp::planning
