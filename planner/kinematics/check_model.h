#pragma once

#include <string>

#include "planner/kinematics/hand_description.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// Check that a model has exactly the physics that the replay assumes.
/// These are gravity, joints with their limits and springs, and actuators of joints.
///
/// Flags and options that change only how a step is computed are accepted.
/// @throws InputError  if a flag disables a part of the physics (gravity, limits, equality, …) or
///     overrides contact parameters; if wind, density or viscosity is not 0, or if an actuator
///     moves no joint (adhesion, site, slider-crank). The message names the model's file and the
///     element.
void CheckPhysics(const CompiledModel& compiled);

/// Check that a hand has all couplings that its model imposes (joint_relations.h).
/// @param file  name of the hand's file in messages.
/// @throws InputError  as ReadJointRelations, and if a coupling of the model is missing or differs.
void CheckCouplings(const HandModel& hand, const std::string& palm, const CompiledModel& compiled,
                    const std::string& file);

/// Check that the palm and the fingertips have colliding geoms that contain the fingertip spheres.
/// Every point of a fingertip sphere must be within 5 mm of the convex hull of its link's geoms.
/// @param file  name of the hand's file in messages.
/// @throws InputError  if not; the message names the body and the distance.
void CheckCollisionGeoms(const HandDescription& description, const CompiledModel& compiled,
                         const std::string& file);

}  // namespace regrasp::kinematics
