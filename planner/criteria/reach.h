#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::criteria {

/// Return the radius of the largest sphere outside the object that touches it at `contact`.
/// It is the largest possible fingertip radius there, at most `limit`, and 0 on a concave edge.
///
/// Shrinking ball algorithm (Ma, Bae and Choi 2012): a sphere tangent at p with inward normal n
/// that contains a surface point q shrinks to the sphere through q, of radius |q − p|² / (−2 n·(q −
/// p)).
///
/// Lengths are in object units. `contact.face` is the face of the contact.
[[nodiscard]] double ComputeClearance(const object::Object& object, const grasp::Contact& contact,
                                      double limit);

/// Required clearance: radius over the diameter of a sphere that touches at the contact.
/// A concave corner has no clearance. The smallest fingertips of the replay require half of it.
inline constexpr double kFingertipClearance = 5e-4;

/// Return true iff a contact has the required clearance.
/// The sphere of that radius must touch the object from outside, at the contact only.
/// @param contact  contact with its face.
[[nodiscard]] bool HasClearance(const object::Object& object, const grasp::Contact& contact);

/// Return true iff a finger may hold the contact.
/// The contact must have clearance, and the surface there must not be rough (Object::IsRough).
[[nodiscard]] bool CanRest(const object::Object& object, const grasp::Contact& contact);

/// Model of a finger with positive radius: a straight rod with a hemispherical end, along the
/// outward normal of its contact. At the contact its end is the sphere that touches there, with
/// centre p − r n. The finger approaches and leaves along the normal, from beyond the far side of
/// the object. Its swept volume is the capsule about the segment from p − r n to p − (r + D) n.
/// This length suffices because no point of the object is farther from p than the diameter D.
///
/// In the plane discs replace spheres. Lengths are in object units, and contacts have their faces.
/// A finger is a point if its radius is 0, and then reaches everything but the walls of sealed
/// cavities (Object::IsEnclosed).

/// Return true iff a finger can reach a contact: the object does not enter the capsule.
/// Touching is allowed, up to rounding.
/// Laws: the result is independent of rigid motion and of the unit of length. A thicker finger
/// reaches no contact that a thinner one of positive radius does not reach.
[[nodiscard]] bool CanReach(const object::Object& object, const grasp::Contact& contact,
                            double radius);

/// Return true iff no two fingers overlap.
/// The centres of their spheres must be at least 2 r apart, up to rounding.
/// Law: the result is independent of the order of the contacts.
[[nodiscard]] bool KeepApart(std::span<const grasp::Contact> contacts, double radius);

/// Check that a finger is not thicker than the object, which indicates a wrong unit of length.
/// @param name  option or field that defines the radius, for the message.
/// @throws InputError  if the radius is larger than the object's diameter.
void CheckFingerRadius(const object::Object& object, double radius, const std::string& name);

/// Check that the torsional friction length of soft fingers is plausible: it is smaller than their
/// contact patches.
/// @param name  option or field that defines the length, for the message.
/// @throws InputError  if it is larger than the object's diameter.
void CheckTorsion(const object::Object& object, double torsion, const std::string& name);

/// Return the centre of the finger's sphere at a contact.
[[nodiscard]] Eigen::Vector3d BallCentre(const grasp::Contact& contact, double radius);

/// Describe why a finger cannot reach a contact.
/// The text has the radius that fits, or the free length of the finger's path.
/// @returns nullopt if it can.
[[nodiscard]] std::optional<std::string> FindObstacle(const object::Object& object,
                                                      const grasp::Contact& contact, double radius);

}  // namespace regrasp::criteria
