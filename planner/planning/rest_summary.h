#pragma once

#include <string>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {

/// The smallest margin of a sequence's grasps at rest to their required half-angles, radians.
[[nodiscard]] double SmallestMargin(const std::vector<Rest>& rests,
                                    const criteria::GraspEvaluator& evaluator);

/// Warnings that name the first grasp where a fingertip has no clearance and, for each criterion
/// that is not met everywhere, the grasp that is weakest in it.
/// @param rests  before all steps and after each.
[[nodiscard]] std::vector<std::string> RestWarnings(const std::vector<Rest>& rests,
                                                    const criteria::GraspEvaluator& evaluator);

}  // namespace regrasp::planning
