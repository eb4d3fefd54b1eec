#pragma once

#include "planner/motion/contact_motion.h"
#include "planner/object/wrench_frame.h"

namespace regrasp {

/// Tries to prove that a moving grasp is force closure for all t in [centre − reach, centre +
/// reach], by forces of degree 1 in t.
///
/// Let q_i and v_i be points and velocities in the contacts' own frame at the centre, G(t) the
/// grasp matrix (force and torque of every contact's force), s = t − centre. With f_i balanced
/// forces of the largest margin inside the cones at the centre and any h_i, the forces f_i + s h_i
/// leave the wrench
///
///     r(s) = (Σ f, Σ q×f) + s (Σ h, Σ q×h + Σ v×f) + s² (0, Σ v×h),
///
/// and h is chosen as the least one whose linear term vanishes. The least forces e(s) that balance
/// the rest have |e| ≤ |r(s)| / σ(s), and the least singular value σ of G changes by no more than
/// reach · (Σ |v_i|²)^½. A force x stays inside a cone of half-angle θ when it changes by less than
/// its distance to the cone's border, x·n sin θ − |x − (x·n) n| cos θ; that is concave in x, so on
/// the segment it is least at an end, and loses at most |x| α when the normal turns by α. Where
/// every contact has distance left, interior forces balance and G has full rank at every t: force
/// closure (Murray, Li and Sastry 1994, Prop. 5.3). Nothing is taken on trust from how f and h were
/// found: all terms are computed from their values.
///
/// Laws: true for a reach is true for every smaller one up to rounding; never true where some t of
/// the interval is not force closure.
/// @param half_angle  θ, radians, in (0, π/2).
[[nodiscard]] bool CertifyForceClosure(const GraspMotion& motion, int dimension, double half_angle,
                                       double centre, double reach);

}  // namespace regrasp
