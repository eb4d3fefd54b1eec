#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/hand_model.h"
#include "planner/kinematics/hand_visuals.h"
#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Hand with the sources of its description.
struct InspectedHand {
  HandDescription description;
  std::filesystem::path model;  ///< file of the model
  HandModel hand;
  std::vector<LinkVisual> visuals;  ///< visual shapes in the reference configuration
  std::vector<JointActuator> actuators;
  std::vector<Conversion> conversions;
  std::vector<std::string> notes;  ///< doubtful results of the derivation, and ActuationWarnings
};

/// Read a file `hand.json`, or derive the hand of an MJCF or URDF model (derive_hand.h).
/// @throws InputError  as ReadHand and DeriveHand.
[[nodiscard]] InspectedHand InspectHand(const std::filesystem::path& path);

/// Return the largest distance of a fingertip's centre from the palm's origin, metres.
/// The configurations are those within the joint limits.
/// The accuracy is about 1 mm: the best sampled configuration is improved by coordinate search.
[[nodiscard]] double LargestReach(const Finger& finger);

/// Format a hand for users: name, palm, up, tables of fingers and joints, notes and conversions.
[[nodiscard]] std::string InspectionText(const InspectedHand& inspected);

}  // namespace regrasp::kinematics
