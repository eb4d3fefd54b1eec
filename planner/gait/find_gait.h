#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/request.h"

// Package overview. The state diagram and the modules are in docs/gait.md, the constants in
// docs/gait_constants.md.
//
// FindGait(request):                                   // find_gait.cc
//   contacts := 400 random surface points + given grasps
//   for each Attempt{margins, patience, simulate}:     // schedule.cc
//     gait := MultiStartSearch(attempt)
//     if no simulation is required or gait executes: return gait
//
// MultiStartSearch:                                    // multi_start_search.cc
//   starts := FindInitialPoses(task)                   // START of the search: initial_pose.cc
//   repeat: add the next start if due; resume the most promising search, which is a
//     BidirectionalSearch or a TurnSearch              // joined_search.cc, on top of GaitSearch
//
// GaitSearch::Run:                                     // gait_search.cc
//   queue := stances at the start of the pose grid     // AddInitialStances, AddGivenStart
//   while the queue is not empty and budget remains:
//     n := pop highest priority                        // NODE: StanceNode in stance_tree.h,
//                                                      //   contact assignment + grid node
//     plan the edge from n.parent; if it fails: continue
//     n.reachable := grid nodes that the holding fingers follow        // object_motion.cc
//     if n reaches the goal: plan its in-hand motions; if feasible: return gait
//     if edges are simulated and the path to n fails: prune; continue
//     for some grid nodes g in n.reachable, for each contact change at g:  // successors.cc
//       queue the best admissible stances              // ScoreAfter
//
// EDGE COST: edges have no additive cost. The priority of a stance, in track steps, is
//   reached step + 0.3 mean step of single fingers - 0.1 offset units - 3 goal distance
//   - 2 sliding steps - 2 earlier expansions - similarity to expanded stances

namespace regrasp::gait {

struct GaitResult {
  std::optional<Gait> gait;
  /// Result of the simulated execution (planning::InHandTask::simulate) of `gait`.
  /// Without a gait, of the candidate that executes farthest. None if nothing was simulated or the
  /// simulator gives no result.
  std::optional<planning::ExecutionResult> execution;
  std::vector<grasp::Contact> contacts;  ///< contacts by number, in object units
  std::string message;                   ///< reason with counts if no gait is found
};

/// Find a gait of a hand that rotates or translates the object.
/// Chooses the initial object pose and the initial grasp unless they are given. The robustness
/// level `preferred` is dropped if it makes the gait much longer.
/// Laws: without a deadline, equal requests give bit-identical gaits for any number of jobs. Every
/// stance is force closure and meets the criteria if possible. Every path is certified (IsClear in
/// finger_path.h).
/// @throws std::invalid_argument  if start_fingers or goal_fingers does not name one finger of the
///     hand per contact of its grasp, or start_joints are not those of the hand.
/// @throws InputError  if fewer than three fingers can touch the object at the start or goal pose
///     in any joint configuration.
[[nodiscard]] GaitResult FindGait(const GaitRequest& request);

}  // namespace regrasp::gait
