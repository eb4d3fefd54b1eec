#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::criteria {

/// The radius of the largest ball that touches the object from outside at `contact` and nowhere
/// enters it, at most `limit`: how thick a fingertip can be there. 0 on a concave edge.
///
/// By the shrinking ball of Ma, Bae and Choi 2012: a ball tangent at p with inward normal n that
/// contains a surface point q shrinks to the one through q, of radius |q − p|² / (−2 n·(q − p)).
///
/// Lengths are the object's own units; `contact.face` is the face that it lies on.
[[nodiscard]] double ComputeClearance(const object::Object& object, const grasp::Contact& contact,
                                      double limit);

/// The clearance that a fingertip needs: the radius of a ball, over the diameter, that touches at
/// the contact. In a concave corner there is none; the smallest fingertips of the replay need half
/// of it.
inline constexpr double kFingertipClearance = 5e-4;

/// True iff a ball of that radius touches the object from outside at the contact and nowhere else.
/// @param contact  knows its face.
[[nodiscard]] bool HasClearance(const object::Object& object, const grasp::Contact& contact);

/// True iff a finger may rest at the contact: it has clearance, and the surface there is not rough
/// (Object::IsRough).
[[nodiscard]] bool CanRest(const object::Object& object, const grasp::Contact& contact);

/// A finger that is not a point: a straight rod of some radius with a round end, along the outward
/// normal of its contact. Where it rests it is the ball that touches at the contact, with centre
/// p − r n; it comes and goes straight along the normal, from beyond the object's far side. What it
/// sweeps is the capsule about the segment from p − r n to p − (r + D) n: no point of the object is
/// farther than the diameter D from p, so that nothing blocks its path after that.
///
/// In the plane all this holds for discs. Lengths are the object's own units; contacts know their
/// faces. A radius of 0 is a finger that is a point, and reaches everything but the walls of sealed
/// cavities (Object::IsEnclosed).

/// True iff the finger can come to the contact and stay there: the object does not enter the
/// capsule. Touching is allowed, up to rounding.
/// Laws: independent of rigid motion and of the unit of length; a thicker finger reaches no contact
/// that a thinner one (of positive radius) does not reach.
[[nodiscard]] bool CanReach(const object::Object& object, const grasp::Contact& contact,
                            double radius);

/// True iff no two of the fingers overlap: the centres of their balls are 2 r apart or more, up to
/// rounding. Law: independent of the order of the contacts.
[[nodiscard]] bool KeepApart(std::span<const grasp::Contact> contacts, double radius);

/// Fingers thicker than the object is long are a mistake in the unit of length.
/// @param name  what gave the radius, for the message.
/// @throws InputError  the radius is larger than the object's diameter.
void CheckFingerRadius(const object::Object& object, double radius, const std::string& name);

/// The centre of the ball at rest.
[[nodiscard]] Eigen::Vector3d BallCentre(const grasp::Contact& contact, double radius);

/// Why a finger cannot reach a contact, for people: what fits there, or how far from the contact
/// its path is blocked. Nullopt where it can.
[[nodiscard]] std::optional<std::string> FindObstacle(const object::Object& object,
                                                      const grasp::Contact& contact, double radius);

}  // namespace regrasp::criteria
