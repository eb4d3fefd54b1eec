#pragma once

#include <cstdint>
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

using planning::Reserve;

/// Rests that a search expands, from all places in the hand together, where nothing else is said.
inline constexpr std::int64_t kDefaultExpanded = 8'000;

/// What is asked of a hand: that the object turns, or goes to a pose, or is held by another grasp
/// in the end, or both.
struct GaitRequest : planning::InHandTask {
  const object::Polyhedron* solid = nullptr;
  criteria::GraspCriteria criteria;
  grasp::Grasp start_grasp;  ///< in the file's units; empty: any
  grasp::Grasp goal_grasp;   ///< the same
  std::uint64_t seed = 0;
  std::int64_t most_expanded = kDefaultExpanded;
  /// Of the gaits with reserve that are found and carried out the one with most to spare
  /// (planning::CarriedOut::spare), instead of the first; where plans are tried.
  bool seeks_most_margin = false;
  Deadline deadline = {};
  int jobs = 1;  ///< searches at a time where plans are tried, ≥ 1
  planning::Progress progress = [](std::string_view) {};
};

/// The fingers that grasps are judged for: as many as the hand has, each with its largest tip.
/// Lengths in the object's unit.
[[nodiscard]] hand::Hand FingersOf(const planning::InHandTask& task);

}  // namespace regrasp::gait
