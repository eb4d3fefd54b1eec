#pragma once

#include <string>

#include "planner/object/object.h"
#include "sim/hand_grasps/grasp_geometry.h"
#include "sim/hand_grasps/grasp_world.h"
#include "sim/hand_grasps/hand_grasp.h"
#include "sim/hand_grasps/whole_hand.h"

namespace regrasp::sim {

/// Check that object and hand have similar sizes.
/// @param where  line of the grasp in messages.
/// @throws InputError  if the object is more than 30 times as large as the hand, or less than a
///     300th of it. The message names the factor 1000 if it explains the difference.
void CheckGraspScale(const HandGrasp& grasp, const WholeHand& hand, const object::Object& object,
                     const std::string& where);

/// Check a grasp for violated conventions of the format.
/// @throws InputError  if the joints are not those of the hand (GraspWorld::CheckJoints), a joint
///     has more than a full turn outside its range, as in degrees, or the palm is farther from the
///     object than the hand is long.
void CheckGraspConventions(const HandGrasp& grasp, const WholeHand& hand,
                           const object::Object& object, const GraspWorld& world,
                           const std::string& where);

/// Return the convention under which a grasp without contacts would touch the object.
/// The candidates are quaternions in the order x, y, z, w, and the pose of the object in the frame
/// of the palm.
/// @returns a noun phrase; empty if no candidate touches the object without deep penetration.
[[nodiscard]] std::string LikelyConvention(const HandGrasp& grasp, const GraspGeometry& geometry,
                                           GraspWorld& world);

}  // namespace regrasp::sim
