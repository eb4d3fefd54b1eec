#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/request.h"

namespace regrasp::gait {

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
  double reached = 0;   ///< without a gait: fraction of the track that the search reached
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
