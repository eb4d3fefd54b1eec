#pragma once

#include <span>

#include "planner/grasp/contact.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Bounds on the size of the disturbances that a loaded grasp resists, newtons.
struct LoadResistance {
  double lower = 0;
  double upper = 0;
};

/// Bound the size of the disturbances that a grasp resists in addition to a load.
/// It is the radius r of the largest ball of wrenches d, |d| ≤ r, for which forces inside the
/// friction cones with Σ n_i·f_i ≤ total_normal balance load + d. Torques count over R, as in the
/// frame. The grasp need not be force closure: fingers that carry an object from below resist
/// disturbances because of its weight. 0 if the load itself is not balanced.
///
/// The method is that of BoundQuality, which is the case without a load. The lower bound is
/// certified up to rounding.
///
/// Laws:
/// - Independent of order and rigid motion.
/// - Never decreases with friction_angle, total_normal or more contacts.
/// - Concave in the load, and proportional to load and total_normal together.
/// @param relative_gap  largest (upper − lower) / upper, at least kLeastRelativeGap.
/// @throws std::invalid_argument  as TestForceClosure, if the load is not finite, or if
///     total_normal is not > 0.
[[nodiscard]] LoadResistance BoundLoadResistance(std::span<const Contact> contacts,
                                                 const object::WrenchFrame& frame,
                                                 double friction_angle, const Wrench& load,
                                                 double total_normal, double relative_gap = 0.01);

/// Return whether a grasp certainly resists a load with all disturbances of a size, newtons.
/// The same as BoundLoadResistance(…).lower ≥ disturbance up to the gap of 1e-3, but faster.
/// @throws std::invalid_argument  as BoundLoadResistance, or if the disturbance is not > 0.
[[nodiscard]] bool ResistsLoad(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                               double friction_angle, const Wrench& load, double total_normal,
                               double disturbance);

}  // namespace regrasp::grasp
