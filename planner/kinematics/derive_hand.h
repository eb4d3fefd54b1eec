#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;

struct DerivedHand {
  HandDescription description;     ///< description without the file of the model
  std::vector<std::string> notes;  ///< doubtful results and omitted parts
};

/// Derive the description of a hand from its model.
///
/// - A fingertip is a colliding body without colliding bodies below it. If several share a joint,
///   the one with the longest chain of joints is used.
/// - The palm is the lowest common ancestor of all fingertips.
/// - The fingertip sphere is fitted (FitTip) to the geom of the fingertip that reaches farthest
///   from the last joint. The pad is on the side to which the last joint flexes, that is the longer
///   side of its range.
/// - Up is the direction to which more than two thirds of the fingers flex. If there is none, it is
///   the direction in which the fingers point in the reference configuration. Up is replaced by an
///   axis of the palm within 10° of it.
/// - Couplings come from equality constraints, `<mimic>` elements, and tendons by which one
///   actuator moves two joints. The independent joint is the one with an actuator.
/// - Names come from the bodies, without common beginnings and endings.
/// @throws InputError  if there are fewer than three fingers, or no common body but the world.
[[nodiscard]] DerivedHand DeriveHand(const CompiledModel& compiled, const std::string& file);

}  // namespace regrasp::kinematics
