#pragma once

#include <string>

namespace regrasp::sampling {

/// Thrown for a negative answer: a random grasp could not be drawn, or a planner has no place for a
/// grasp that it is given. PlanResult::Status::kNoGrasp where planners end.
struct NoGrasp {
  std::string message;
};

}  // namespace regrasp::sampling
