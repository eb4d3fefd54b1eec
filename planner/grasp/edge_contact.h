#pragma once

#include "planner/grasp/contact.h"
#include "planner/object/polygon.h"

namespace regrasp {

/// The contact at a parameter of an edge, 0 at its first end and 1 at its last, and back.
[[nodiscard]] Contact ContactAt(const Polygon& polygon, int edge, double parameter);
[[nodiscard]] double ParameterOf(const Polygon& polygon, const Contact& contact);

}  // namespace regrasp
