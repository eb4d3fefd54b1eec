#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
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
  std::int64_t expanded_ = 0;              ///< number of expansions over all searches
  int farthest_ = 0;                       ///< farthest track step of all searches
  std::int64_t expanded_at_farthest_ = 0;  ///< number of expansions when it was reached
};

/// Robustness margins of a gait beyond the request. Fingers do not slide in such gaits.
struct RobustnessMargins {
  double quality = 0;    ///< minimum grasp quality ε
  double clearance = 0;  ///< additional clearance of links, metres
  /// Required force margin at rolled contacts (HandSetup::force_margin).
  /// None: rolling is not modelled, and the gait is robust only if its simulated execution
  /// succeeds.
  std::optional<double> force_margin = {};
};

struct FoundGait {
  std::optional<Gait> gait;
  std::string message;  ///< reason, if there is no gait
};
/// Searches a gait with one of several robustness margins, assigned to the initial poses in turn.
/// Empty margins: no robustness. With margins, edges are simulated if the request has a simulator.
using FindOne = std::function<FoundGait(const GaitRequest& asked,
                                        std::span<const RobustnessMargins> margin_sets)>;

/// Search a robust gait without simulated execution, with decreasing margins.
/// A gait that is much longer than `without` is rejected.
/// @param without  result without robustness margins; empty if robustness is required.
/// @returns the first robust gait; otherwise `without`, with the reason if it has no gait.
[[nodiscard]] FoundGait FindRobustGait(const GaitRequest& request, const FindOne& find,
                                       const FoundGait& without);

/// Gait with the result of its simulated execution.
/// Without a gait, the result of the candidate that executes farthest; nullopt if the simulator
/// gives no result or nothing was simulated.
struct SimulatedGait {
  FoundGait found;
  std::optional<planning::ExecutionResult> execution = {};
};

/// Return which of `steps` plan steps fails in simulation, and why: "fails at step 2 of 7 …".
[[nodiscard]] std::string FailureText(const planning::ExecutionResult& execution,
                                      std::size_t steps);

/// Search a gait that executes in simulation (planning::InHandTask::simulate).
/// Runs the schedules of attempts with varying margins and random streams. If none executes and
/// robustness is only preferred, searches a gait without margins. If the simulator gives no result,
/// the search runs without simulation. With `seeks_most_margin`, all attempts run. The
/// result is the gait that fails under the fewest conditions (planning::InHandTask::rate); among
/// equals, the first one with the largest tolerance margin.
/// @param contacts  contacts by number, in object units.
/// @returns a gait that executes; if robustness is only preferred, possibly one that does not.
[[nodiscard]] SimulatedGait FindExecutableGait(const GaitRequest& request,
                                               const std::vector<grasp::Contact>& contacts,
                                               const FindOne& find);

}  // namespace regrasp::gait
