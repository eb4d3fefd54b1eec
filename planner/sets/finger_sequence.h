#pragma once

#include <optional>
#include <vector>

#include "planner/planning/candidate_sequence.h"

namespace regrasp::sets {

/// Assign fingers to the contacts of the next waypoint of a sliding step.
///
/// Each finger stays on its face. If the next grasp has no contact on a finger's face, this finger
/// takes the remaining contact.
/// @param next  as many contacts as there are holding fingers; at most one on a new face.
[[nodiscard]] plan::FingerGrasp FollowTo(const plan::FingerGrasp& holding,
                                         const grasp::Grasp& next);

/// Sequence of steps under construction.
class FingerSequence {
 public:
  /// @param start  initial grasp.
  /// @param fingers  number of fingers of the hand.
  FingerSequence(const grasp::Grasp& start, int fingers);

  /// Append a finger switch to a grasp; no step if it is the current grasp.
  ///
  /// Two consecutive switches are merged if the hand has enough fingers.
  /// @param region  half-width of the contact region of the new contacts, if known; such a switch
  ///     is not merged.
  void SwitchTo(const grasp::Grasp& after, std::optional<search::VertexPair> chosen_for,
                std::optional<double> region = std::nullopt);

  /// Append a sliding step along waypoints, the first of which is the current grasp.
  void AlignAlong(const std::vector<grasp::Grasp>& waypoints,
                  std::optional<search::VertexPair> chosen_for);

  [[nodiscard]] const planning::CandidateSequence& candidate() const { return candidate_; }

 private:
  void AddStep(plan::Step step, std::optional<search::VertexPair> chosen_for);
  [[nodiscard]] bool CanJoinLastSwitch(const grasp::Grasp& after) const;

  planning::CandidateSequence candidate_;
  int fingers_;
  plan::FingerGrasp holding_;
  plan::FingerGrasp held_before_;  ///< grasp before the last step
};

}  // namespace regrasp::sets
