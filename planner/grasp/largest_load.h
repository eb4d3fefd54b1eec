#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/quality.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Compute the largest s at which forces inside the friction cones balance a load.
/// The forces with Σ n_i·f_i = total_normal balance `load` + s · total_normal · `direction`:
///
///     max s   subject to   Σ G_i f_i + load + s · total_normal · direction = 0,   f_i ∈ C(n_i).
///
/// This is a linear program over the circular cones (planner/grasp/wrench_simplex.h); its dual
/// certifies `upper`. With a direction of unit length and no load, s is the distance from the
/// origin to the boundary of Ferrari and Canny's wrench set along −direction. It is then at least
/// the quality ε of a force-closure grasp.
///
/// Laws: concave in the load. Every smaller s ≥ 0 is balanced too, because the set of balanced
/// loads is convex. Never decreases when the friction angle increases.
///
/// @param direction  direction of the load, not zero.
/// @returns bounds on s; nullopt if not even `load` is balanced.
/// @throws std::invalid_argument  as ComputeGraspForces, or if the direction is zero or not finite.
[[nodiscard]] std::optional<QualityBounds> ComputeLargestLoad(
    std::span<const Contact> contacts, const object::WrenchFrame& frame, double friction_angle,
    const Wrench& load, const Wrench& direction, double total_normal);

}  // namespace regrasp::grasp
