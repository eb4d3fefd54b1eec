#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::planning {

/// What every planner answers.
struct PlanResult {
  enum class Status {
    kFound,
    kNoSequence,  ///< no sequence joins the two grasps in this planner's graph
    kNoGrasp,     ///< a random start or goal could not be drawn, or a given one is in no set
  };
  Status status = Status::kFound;
  std::string message;  ///< for a negative answer: what was searched
  /// Where plans were found that a hand carries none of out, why not: of the one that came
  /// farthest.
  std::optional<plan::Reason> trial;
  std::vector<std::string> warnings;  ///< of grasps that don't meet the criteria
  std::vector<std::string> notes;     ///< what was gained by making the sequence better, for people
  /// The plan, all but the object's file, digest and scale. Set where the status is kFound.
  std::optional<plan::Plan> plan;
  double margin = 0;  ///< smallest of half_angle − required half-angle over all grasps at rest
};

}  // namespace regrasp::planning
