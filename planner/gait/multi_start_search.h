#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/gait.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/joined_search.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/request.h"

namespace regrasp::gait {

/// Configuration of the searches from one initial pose.
struct SearchTerms {
  const HandSetup& setup;
  criteria::GraspMemory& memory;    ///< contacts of the setup under the same numbers
  SimulateExecution simulate = {};  ///< simulator of edges; none: paths are not simulated
};

/// Search from several initial object poses, interleaved.
/// Starts with the best pose and adds poses while the search continues. Searches that move the
/// object farther receive more of the budget.
class MultiStartSearch {
 public:
  /// @param request  request; outlives this object.
  /// @param terms  one or more configurations, assigned to the initial poses in turn.
  MultiStartSearch(const GaitRequest& request, std::vector<SearchTerms> terms, GaitEnds ends);

  /// Run the search.
  /// @returns the first gait, with merged in-hand motions; nullopt if the budget, the patience or
  ///     the deadline is exhausted, or all searches have ended.
  [[nodiscard]] std::optional<Gait> Search();

  /// Return the counts of each initial pose.
  [[nodiscard]] std::vector<GaitCounts> counts() const;
  /// Return the fraction of the track that was reached; 0 without an initial pose.
  [[nodiscard]] double reached() const { return reached_; }
  /// Return the tracks from all initial poses that were drawn.
  [[nodiscard]] const std::vector<PoseTrack>& drawn_tracks() const { return drawn_tracks_; }

 private:
  struct Start {
    const SearchTerms& terms;
    RandomStream random;
    std::unique_ptr<StartSearch> search = nullptr;
  };
  /// Return the total number of expansions at which the next initial pose is added.
  [[nodiscard]] std::int64_t BudgetForNextStart() const;
  /// Return the search that continues; null if all are exhausted.
  Start* Next();
  /// Add the search of the next initial pose.
  /// @returns false if there is none.
  bool OpenNextStart();
  /// Create the search along a track; null without idle configuration.
  std::unique_ptr<StartSearch> SearchAlong(const PoseTrack& track, const SearchTerms& terms,
                                           RandomStream& random);
  /// Draw initial poses, each with a track to the goal.
  /// From a given start pose, all tracks of the task.
  /// @returns false if the number of draws is exhausted.
  bool DrawTracks();

  const GaitRequest& request_;
  std::vector<SearchTerms> terms_;
  GaitEnds ends_;
  RandomStream random_;
  ObjectTask task_;
  std::vector<PoseTrack> tracks_;  ///< unused tracks from initial poses, best last
  std::vector<PoseTrack> drawn_tracks_;
  int drawings_ = 0;
  std::size_t opened_ = 0;  ///< number of used poses
  std::vector<std::unique_ptr<Start>> starts_;
  std::int64_t expanded_ = 0;             ///< number of expansions over all searches
  double reached_ = 0;                    ///< largest reached fraction of a track
  std::int64_t expanded_at_reached_ = 0;  ///< number of expansions when it was reached
};

}  // namespace regrasp::gait
