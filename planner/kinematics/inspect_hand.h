#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"
#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/kinematics/joint_actuators.h"
#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// A hand, and where what is known of it comes from.
struct InspectedHand {
  HandDescription description;
  std::filesystem::path model;  ///< its file
  HandModel hand;
  std::vector<LinkVisual> visuals;  ///< at rest
  std::vector<JointActuator> actuators;
  std::vector<Conversion> conversions;
  std::vector<std::string> notes;  ///< doubts of the derivation, and ActuationWarnings
};

/// Reads a file `hand.json`, or derives the hand of an MJCF or URDF model (derive_hand.h).
/// @throws InputError  as ReadHand and DeriveHand.
[[nodiscard]] InspectedHand InspectHand(const std::filesystem::path& path);

/// The largest distance of a tip's centre from the palm's origin within the limits, metres, to
/// about a millimetre: the best of sampled postures, improved drive by drive.
[[nodiscard]] double LargestReach(const Finger& finger);

/// For people: name, palm, up; a table of fingers, one of joints; couplings, notes, conversions.
[[nodiscard]] std::string InspectionText(const InspectedHand& inspected);

}  // namespace regrasp::kinematics
