#pragma once

#include <optional>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/quality.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// The largest s such that forces inside the friction cones with Σ n_i·f_i = total_normal balance
/// `load` + s · total_normal · `direction`:
///
///     max s   subject to   Σ G_i f_i + load + s · total_normal · direction = 0,   f_i ∈ C(n_i).
///
/// A linear program over the true cones (planner/grasp/wrench_simplex.h); `upper` is certified by
/// its dual. With a direction of unit length and no load it is the distance from the origin to the
/// boundary of Ferrari and Canny's wrench set along −direction, so never less than the quality ε
/// of a force-closure grasp.
///
/// Laws: concave in the load; the loads that a grasp balances are convex, so it balances every
/// smaller s ≥ 0 too; it never falls where the half-angle grows.
///
/// @param direction  not zero.
/// @returns nullopt where not even `load` is balanced.
/// @throws std::invalid_argument  as ComputeGraspForces; direction zero or not finite.
[[nodiscard]] std::optional<QualityBounds> ComputeLargestLoad(std::span<const Contact> contacts,
                                                              const object::WrenchFrame& frame,
                                                              double half_angle, const Wrench& load,
                                                              const Wrench& direction,
                                                              double total_normal);

}  // namespace regrasp::grasp
