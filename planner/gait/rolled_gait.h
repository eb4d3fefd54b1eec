#pragma once

#include <optional>
#include <string>

#include "planner/base/random.h"
#include "planner/collision/shape_contact.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {

/// Gait with rolling contacts, or the segment at which there is none.
struct RolledGait {
  std::optional<Gait> gait;
  int segments = 0;          ///< number of segments before the one that fails, or all
  plan::Reason reason = {};  ///< reason of the failure
};

/// Let the fingertips of a gait roll without slipping in its in-hand motions.
///
/// A gait of the search keeps every contact at a fixed point of the object while the object
/// rotates. A real fingertip rolls there, by its radius times the rotation, up to centimetres. This
/// function repeats the gait with rolling contacts: the object moves as before, the joints follow
/// the contacts, and fingers leave from their rolled contacts. Placed fingers reach the
/// contacts of the gait.
///
/// In a step of the object by at most 0.02 rad and 1 mm, a contact rolls by Δθ × (r n) and remains
/// on the surface, across edges (Montana 1988 for a sphere). Δθ is the rotation of the fingertip's
/// link relative to the object. Joints are those of the gait plus the smallest change that reaches
/// the contact.
///
/// Laws: object poses, contact changes and their order are those of the gait. Between any two
/// keyframes, fingertips are within kTipOff of their contacts, hand and object keep the margin
/// (IsClear), and the grasp is force closure (motion::FindMotionProof).
///
/// @param surface  surface of the object.
/// @param friction_angle  friction angle, radians.
/// @param gait  gait with merged in-hand motions.
/// @param random  random stream for the paths of fingers.
/// @returns no gait if a finger cannot follow (kTipOffContact), something is too close
///     (kHandCollides), force closure is lost (kNotForceClosure), or fingers slide after a contact
///     has rolled (kDiscontinuous).
[[nodiscard]] RolledGait RollContacts(const HandSetup& setup, const collision::BallContact& surface,
                                      double friction_angle, const Gait& gait, RandomStream random);

}  // namespace regrasp::gait
