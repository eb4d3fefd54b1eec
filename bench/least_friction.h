#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"

namespace regrasp::bench {

/// Compute the least friction coefficient with which hard contacts balance each of the loads,
/// except for 3 % of it.
/// The sum of the normal forces is at most `most_normal`, N. With slightly less friction the object
/// cannot stay in place under all of these loads. The relative precision is 1e-3.
/// @param contacts  contacts, in the unit of length of `frame`.
/// @returns tangent of the friction angle, at least 1e-4; infinity if 10 is not enough.
[[nodiscard]] double LeastFriction(std::span<const grasp::Contact> contacts,
                                   const object::WrenchFrame& frame,
                                   std::span<const grasp::Wrench> loads, double most_normal);

}  // namespace regrasp::bench
