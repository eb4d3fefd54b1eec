#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// The couplings of a model's joints among those that are given: from equality constraints and
/// mimics, and from tendons of fixed coefficients that one actuator pulls. Of two joints the one
/// that an actuator turns leads; of none or both the one that the model says, of a tendon the
/// first.
/// @param fingers  the joints of each finger, from the palm to the tip.
/// @param notes  gets what is doubtful: couplings that are no ratio, or of two fingers.
[[nodiscard]] std::vector<HandDescription::Coupling> DeriveCouplings(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers,
    std::vector<std::string>& notes);

}  // namespace regrasp::kinematics
