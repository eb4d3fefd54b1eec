#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/kinematics/hand_model.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/plan_request.h"

namespace regrasp::gait {

using planning::RobustnessLevel;

/// Default budget of a search: number of expanded stances over all initial poses.
inline constexpr std::int64_t kDefaultExpanded = 8'000;

/// Request for a gait: rotate the object, move it to a pose, change its grasp, or several of these.
struct GaitRequest : planning::InHandTask {
  const object::Polyhedron* solid = nullptr;
  criteria::GraspCriteria criteria;
  grasp::Grasp start_grasp;  ///< grasp in object units; empty: any grasp
  grasp::Grasp goal_grasp;   ///< grasp in object units; empty: any grasp
  std::uint64_t seed = 0;
  std::int64_t most_expanded = kDefaultExpanded;
  /// Number of expanded stances without progress along the track after which the search ends.
  std::int64_t patience = std::numeric_limits<std::int64_t>::max();
  /// Select the executable gait that fails under the fewest conditions (`rate`), among these the
  /// one with the largest tolerance margin (planning::ExecutionResult::tolerance_margin), instead
  /// of the first one. Requires a simulator.
  bool seeks_most_margin = false;
  /// Append the likely causes of a failure to its message (LikelyCauses).
  bool names_causes = false;
  Deadline deadline = {};
  int jobs = 1;  ///< number of parallel searches if plans are simulated, ≥ 1
  planning::Progress progress = [](std::string_view) {};
};

/// Return the hand used by the grasp criteria, in object units.
/// It has all fingers, each with the largest fingertip radius.
[[nodiscard]] hand::Hand FingersOf(const planning::InHandTask& task);

}  // namespace regrasp::gait
