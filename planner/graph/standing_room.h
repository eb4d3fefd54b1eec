#pragma once

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp {

/// A fingertip needs room: a ball of this radius, over the diameter, that touches at the contact.
/// In a concave corner no finger can stand; the smallest fingertips of the replay need half of it.
inline constexpr double kStandingRoom = 5e-4;

/// True iff a ball of that radius touches the object from outside at the contact and nowhere else.
/// @param contact  knows its face.
[[nodiscard]] bool HasStandingRoom(const Object& object, const Contact& contact);

}  // namespace regrasp
