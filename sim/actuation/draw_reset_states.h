#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "sim/actuation/reset_states.h"

namespace regrasp {
struct ShareInterval;  // planner/base/binomial.h
}

namespace regrasp::sim {

/// A rest that the hand is to hold.
struct RestToHold {
  plan::HandState state;
  plan::FingerGrasp grasp;  ///< in the object's units
};

/// Draws rests. @returns nullopt where none is found in a bounded number of tries.
using DrawRest = std::function<std::optional<RestToHold>(RandomStream&)>;

struct DrawnStatesOptions {
  int count = 0;
  std::uint64_t seed = 0;
  /// Rests that are tried for one state: where one of fifty is held, one of a billion has none.
  int most_tried = 1000;
  int jobs = 1;  ///< threads
  std::function<void(int done)> told =
      {};  ///< after every state, by one thread at a time; may be empty
};

/// Reset states, and what became of all rests that were drawn for them.
struct DrawnStates {
  std::vector<ResetState> states;               ///< none where `message` says why
  std::map<plan::Reason, std::int64_t> fallen;  ///< rests that were not held, by reason
  std::int64_t unbalanced = 0;  ///< rests that no forces hold (ResetStates::SqueezeOf), not tried
  std::string message;          ///< what stopped it; empty: nothing
  // Of the world that they are for.
  std::vector<std::string> joint_names;
  std::vector<std::string> control_names;
  double timestep_s = 0;

  [[nodiscard]] std::int64_t fallen_count() const;
  /// Of all rests that were tried, those that were not held.
  [[nodiscard]] double fallen_share() const;
  /// Of that share, as if their number had been given, at kTrialConfidence.
  [[nodiscard]] ShareInterval interval() const;
};

/// Draws rests until so many are reset states. For each state rests are drawn until one is held;
/// none of `most_tried` ends it all.
///
/// Laws: state k depends on the seed and k alone, whatever the number of threads; of N states the
/// first M are those that M alone are.
/// @param make_draw  called once for each thread: what it returns is used by that one.
/// @throws InputError  as ResetStates.
[[nodiscard]] DrawnStates DrawResetStates(const kinematics::HandFile& file,
                                          const object::Polyhedron& solid, double scale,
                                          const ResetStateOptions& states,
                                          const DrawnStatesOptions& options,
                                          const std::function<DrawRest()>& make_draw);

}  // namespace regrasp::sim
