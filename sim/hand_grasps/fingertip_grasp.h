#pragma once

#include <string>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/hand_grasps/hand_grasp.h"

namespace regrasp::sim {

/// Largest distance of a fingertip sphere from the surface, on either side, at which it is a
/// contact of a hand grasp, metres.
inline constexpr double kFingertipTolerance = 2e-3;

/// Largest distance of contacts of one finger in two grasps that are one contact, metres.
inline constexpr double kSameContactTolerance = 5e-4;

/// Hand and object of a plan that starts or ends at a hand grasp.
struct FingertipSetup {
  const kinematics::HandFile& hand;
  const object::Polyhedron& solid;
  std::string object_file;  ///< file name of the object, as in plans
  double scale = 1;         ///< metres per unit of the object's file
  double clearance = 1e-3;  ///< smallest distance of links, palm and object, metres
};

/// Convert a hand grasp to a state of a hand that holds the object with its fingertips.
///
/// The contacts are those of all fingertip spheres within kFingertipTolerance of the surface.
/// Inverse kinematics moves these spheres onto the surface, near the angles of the grasp. All other
/// joints keep their angles. `pregrasp` and `target` are not used. Force closure is not checked.
/// @param name  name of the grasp in messages.
/// @returns state and contacts in the order of the fingers. Contacts are in the unit of the
/// object's
///     file; their faces are set.
/// @throws InputError  if object, scale or joints are not those of the setup, a joint is outside
/// its
///     range, fewer than three fingertips touch the surface, one of them touches an edge or is
///     deeper than the tolerance, or another link, the palm or another finger is too near.
[[nodiscard]] plan::HandEnd FingertipGraspOf(const HandGrasp& grasp, const FingertipSetup& setup,
                                             const std::string& name);

/// Let a goal have the contacts of a start that the same finger has within kSameContactTolerance.
/// Without this, the finger must be lifted to reach a point that it nearly touches.
/// @param scale  metres per unit of the object's file.
void KeepContacts(const plan::HandEnd& start, double scale, plan::HandEnd& goal);

}  // namespace regrasp::sim
