#pragma once

#include <span>

#include "planner/planning/candidate_sequence.h"

namespace regrasp::planning {

/// The finger switch from the fingers that hold to the contacts that are to hold after it: places
/// the contacts that are new with the lowest free fingers and releases those that are gone. A
/// contact is the same where its point and normal are, bit for bit.
/// @throws std::invalid_argument  the hand has too few fingers.
[[nodiscard]] plan::Switch MakeSwitch(const plan::FingerGrasp& before, const grasp::Grasp& after,
                                      int fingers);

/// Turns grasps that follow each other into finger switches of a hand of `fingers` fingers.
///
/// The first grasp's contacts get fingers 0, 1, … in their order. Each step places the contacts
/// that are new with the lowest free fingers and releases those that are gone; a contact is the
/// same where its point and normal are, bit for bit. Grasps equal to the one before give no step.
/// @throws std::invalid_argument  no grasp, or a step for which the hand has too few fingers.
[[nodiscard]] CandidateSequence MakeSwitchSequence(std::span<const grasp::Grasp> grasps,
                                                   int fingers);

}  // namespace regrasp::planning
