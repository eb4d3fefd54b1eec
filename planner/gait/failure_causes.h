#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/gait/gait_search.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/request.h"

namespace regrasp::gait {

/// Return a count with its noun: "1 grasp", "2 grasps".
[[nodiscard]] std::string CountText(std::int64_t count, const std::string& noun);

/// Return the noun for the searches of a request: "initial pose", or "attempt" if that is given.
[[nodiscard]] std::string SearchNoun(const GaitRequest& request);

/// Counts of all searches of a request that found no gait.
struct SearchEvidence {
  /// Tracks from the initial poses of the search with the smallest seed, and that seed.
  std::vector<PoseTrack> tracks = {};
  std::optional<std::uint64_t> tracks_seed = {};
  int searches = 0;        ///< number of searched initial poses
  GaitCounts counts = {};  ///< sums over all searches
  double farthest = 0;     ///< largest fraction of a track that was reached, in [0, 1]
  int unrolled = 0;        ///< number of found gaits whose contacts cannot roll
  /// Grasp force of the failed step of the best candidate; without one, of some initial grasp.
  std::optional<planning::GraspForceNeed> force = {};

  /// Add the counts of a search from several initial poses.
  /// @param counts_reach  whether `farthest` includes it. Searches without simulation reach farther
  ///     than those with simulation.
  void Add(const std::vector<GaitCounts>& of_poses, bool counts_reach = true);
};

/// Likely cause of a failed search.
struct FailureCause {
  std::string name;     ///< name of its section in docs/likely_causes.md
  std::string figures;  ///< measured values that support it, one clause
};

/// Range of distances that two fingertips can have between their surfaces, if they face each other.
struct GripRange {
  double smallest = 0;  ///< metres; 0 if two fingertips can touch
  double largest = 0;   ///< metres; 0 if no two fingertips face each other
};

/// Measure the grip range of a hand with sampled joint configurations.
/// Two fingertips face each other if the angle between the pointing direction of each and the line
/// to the other fingertip is within the limit of the inverse kinematics
/// (kinematics::ConfigurationLimits::approach). The samples include all combinations of joint
/// limits. Collisions of links are ignored.
[[nodiscard]] GripRange MeasureGripRange(const kinematics::HandModel& hand);

/// Return the likely causes of a failed search, with the most specific one first.
///
/// | name | condition |
/// | --- | --- |
/// | too-heavy | the failed grasp requires a larger grasp force than the actuators exert |
/// | too-thick | no grasp is found, and the object is wider than the largest grip |
/// | too-thin | no grasp is found, and the object's diameter is below the smallest grip; or fingers
///   collide in 9 of 10 grasps, and the object is thinner than a fingertip |
/// | out-of-reach | in each initial pose fewer than three fingers reach the object somewhere on the
///   path |
/// | finger-always-required | a finger of a hand with more than three holds every grasp |
/// | contacts-roll-off | contacts of found gaits cannot roll, half of the grasps are lost by
///   rolling, or half of the failed simulations end with a fingertip that leaves its contact |
/// | time-limit | the deadline passed |
/// | search-budget | no other cause applies, and a search ended without a gait |
[[nodiscard]] std::vector<FailureCause> LikelyCauses(const HandSetup& setup,
                                                     const GaitRequest& request,
                                                     const SearchEvidence& evidence);

/// Format causes for a message: "likely cause: too-heavy (…)"; empty if there are none.
[[nodiscard]] std::string CausesText(const std::vector<FailureCause>& causes);

}  // namespace regrasp::gait
