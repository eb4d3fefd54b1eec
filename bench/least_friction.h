#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"

namespace regrasp::bench {

/// The least friction with which hard points balance each of some loads, all but 3 % of it, with
/// normal forces whose sum is no more than `most_normal`, newtons. With a little less an object
/// can't stay where it is under all of these loads. To a thousandth of itself.
/// @param contacts  in the unit of length of `frame`.
/// @returns the tangent of the half-angle, at least 1e-4; infinity where 10 is not enough.
[[nodiscard]] double LeastFriction(std::span<const grasp::Contact> contacts,
                                   const object::WrenchFrame& frame,
                                   std::span<const grasp::Wrench> loads, double most_normal);

}  // namespace regrasp::bench
