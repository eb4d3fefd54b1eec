#pragma once

#include <string>

#include "planner/kinematics/hand_description.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// Check that a model moves under the physics that the replay assumes, and under no other: gravity,
/// joints with their limits and springs, actuators of joints.
///
/// Accepted are the flags and options that change how a step is computed and not what it models.
/// @throws InputError  a flag turns off a part of the physics (gravity, limits, equality, …) or
///                     overrides contact parameters; wind, density or viscosity is not 0; an
///                     actuator moves no joint (adhesion, site, slider-crank). Names the model's
///                     file and the element.
void CheckPhysics(const CompiledModel& compiled);

/// Check that the couplings of a hand include all that its model imposes (joint_relations.h).
/// @param file  name of the hand's file in messages.
/// @throws InputError  as ReadJointRelations, and if the hand has no such coupling or another one.
void CheckCouplings(const HandModel& hand, const std::string& palm, const CompiledModel& compiled,
                    const std::string& file);

/// Check that the palm and the fingertips have geoms that collide, and that every point of a
/// fingertip sphere is within 5 mm of the convex hull of its link's geoms.
/// @param file  name of the hand's file in messages.
/// @throws InputError  names the body and the distance.
void CheckCollisionGeoms(const HandDescription& description, const CompiledModel& compiled,
                         const std::string& file);

}  // namespace regrasp::kinematics
