#pragma once

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// The total normal force with which a hand would hold an object, newtons: kGripSafety times what
/// its weight needs in the grasp of the plan that carries it worst, at most kStrongestGrip_N.
///
/// With s the largest weight over the squeeze that forces inside the cones balance, smallest over
/// the grasps at rest and the waypoints of aligns, a weight W needs W / s. The plane carries a
/// planar object; to lift it out takes W / μ of fingers that stand upright around it, which is what
/// counts there, and where no grasp carries any weight.
/// @param located     contacts placed on the object.
/// @param entries     how many entries count, the hold first.
/// @param half_angle  friction, radians.
[[nodiscard]] double HandSqueeze(const object::Object& object, const plan::Plan& located,
                                 int entries, double half_angle, double mass_kg);

/// People grip an object 1.4 to 2 times as hard as what just holds it (Johansson and Westling
/// 1984).
inline constexpr double kGripSafety = 2;
/// Pinching with the palm, strong hands press some 100 N from each side (Mathiowetz et al. 1985).
inline constexpr double kStrongestGrip_N = 200;

}  // namespace regrasp::sim
