#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// Return the couplings of a model's fingers (joint_relations.h): each group of related joints has
/// one independent joint, which all others follow.
///
/// The independent joint is one that an actuator moves. If none or several are moved, it is one
/// that follows no other joint in the model.
/// @param fingers  joints of each finger, from the palm to the tip.
/// @param notes    gets the joints that share an actuator by a tendon, whose ratio is an
/// assumption.
/// @throws InputError  as ReadJointRelations, and if relations contradict each other.
[[nodiscard]] std::vector<HandDescription::Coupling> DeriveCouplings(
    const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers,
    std::vector<std::string>& notes);

}  // namespace regrasp::kinematics
