#pragma once

#include <optional>
#include <vector>

#include "planner/planning/candidate_sequence.h"

namespace regrasp::sets {

/// The same fingers at the contacts of the next waypoint of an align: each stays on its face, and
/// the one whose face is gone goes to the contact that is left.
/// @param next  as many contacts as fingers hold, at most one on a face that none was on before.
[[nodiscard]] plan::FingerGrasp FollowTo(const plan::FingerGrasp& holding,
                                         const grasp::Grasp& next);

/// A sequence in the making: what the hand does next.
class FingerSequence {
 public:
  /// @param fingers  of the hand.
  FingerSequence(const grasp::Grasp& start, int fingers);

  /// Switches to a grasp; no step where it holds it already. Two switches in a row are one where
  /// the hand has the fingers.
  /// @param region  what is known of how far the contacts placed may be off.
  void SwitchTo(const grasp::Grasp& after, std::optional<search::VertexPair> chosen_for,
                std::optional<double> region = std::nullopt);

  /// Aligns along waypoints, the first of which is the grasp that it holds.
  void AlignAlong(const std::vector<grasp::Grasp>& waypoints,
                  std::optional<search::VertexPair> chosen_for);

  [[nodiscard]] const planning::CandidateSequence& candidate() const { return candidate_; }

 private:
  void AddStep(plan::Step step, std::optional<search::VertexPair> chosen_for);
  [[nodiscard]] bool CanJoinLastSwitch(const grasp::Grasp& after) const;

  planning::CandidateSequence candidate_;
  int fingers_;
  plan::FingerGrasp holding_;
  plan::FingerGrasp held_before_;  ///< before the last step
};

}  // namespace regrasp::sets
