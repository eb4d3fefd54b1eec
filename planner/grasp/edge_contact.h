#pragma once

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp::grasp {

/// The contact at a parameter of an edge, 0 at its first end and 1 at its last, and back.
[[nodiscard]] Contact ContactAt(const object::Polygon& polygon, FaceIndex edge, double parameter);
[[nodiscard]] double ParameterOf(const object::Polygon& polygon, const Contact& contact);

}  // namespace regrasp::grasp
