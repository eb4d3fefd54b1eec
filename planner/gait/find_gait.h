#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/gait/gait.h"
#include "planner/gait/home.h"
#include "planner/kinematics/hand_model.h"
#include "planner/object/polyhedron.h"
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
  bool seeks_most_spare = false;
  Deadline deadline = {};
  int jobs = 1;  ///< searches at a time where plans are tried, ≥ 1
  planning::Progress progress = [](std::string_view) {};
};

struct GaitResult {
  std::optional<Gait> gait;
  /// How far the hand carries it out, as the request's test has it. Where there is no gait because
  /// it carries none out, of the one that came farthest. None: nothing was tried, or nothing tells.
  std::optional<planning::CarriedOut> trial;
  std::vector<grasp::Contact> contacts;  ///< by the numbers that the gait has, the object's units
  std::string message;                   ///< where there is none: what stopped it, counted
};

/// The fingers that grasps are judged for: as many as the hand has, each with its largest tip.
/// Lengths in the object's unit.
[[nodiscard]] hand::Hand FingersOf(const planning::InHandTask& task);

/// Finds a gait of the hand that turns the object: chooses where in the hand it begins and with
/// which grasp. A preferred reserve is left out where the gait gets much longer by it.
///
/// Laws: without a deadline the same request gives the same gait, bit for bit, with any jobs; every
/// rest is force closure and meets the criteria where it can; every path is certified
/// (certified_path.h).
/// @throws std::invalid_argument  start_fingers are not one of the hand for each contact.
/// @throws InputError  fewer than three fingers can touch the object at the start or goal pose,
///     however they are bent.
[[nodiscard]] GaitResult FindGait(const GaitRequest& request);

}  // namespace regrasp::gait
