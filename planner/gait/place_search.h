#pragma once

#include <cstdint>
#include <optional>

#include "planner/base/deadline.h"
#include "planner/gait/gait.h"
#include "planner/gait/gait_search.h"

namespace regrasp::gait {

/// A search of a gait from one place in the hand, which goes on as often as it is asked to.
class PlaceSearch {
 public:
  virtual ~PlaceSearch() = default;

  /// Whether some fingers can hold the goal grasp, if there is one, at the goal pose.
  [[nodiscard]] virtual bool GoalIsHeld() const { return true; }
  /// As GaitSearch::Run; rests from both ends count.
  [[nodiscard]] virtual std::optional<Gait> Run(std::int64_t most_expanded,
                                                const Deadline& deadline) = 0;
  /// Whether nothing is left to expand.
  [[nodiscard]] virtual bool IsExhausted() const = 0;
  [[nodiscard]] virtual GaitCounts counts() const = 0;
};

}  // namespace regrasp::gait
