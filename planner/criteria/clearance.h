#pragma once

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

}  // namespace regrasp::criteria
