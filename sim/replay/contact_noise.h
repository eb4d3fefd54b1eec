#pragma once

#include "planner/base/random.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::sim {

/// How far off fingers are when they are put to a point of the surface.
struct ContactNoise {
  double deviation = 0;  ///< standard deviation along the surface, each direction; object's unit
  double fingertip = 0;  ///< radius of the fingertip; object's unit
};

/// The plan as a hand carries it out that puts its fingers beside where it should: every contact
/// point is moved on its own face by a normal deviate along each direction of the face.
///
/// A finger is off by one draw as long as it stays at a point, through rests and aligns and when
/// its normal turns there; whenever it comes to another point it is drawn anew. On the border of
/// two faces a contact moves along the border only; where more meet, and at a vertex in the plane,
/// it stays. A draw whose path from the planned point leaves the face, or where no ball of the
/// fingertip's radius fits, is drawn again, kMostNoiseDraws times at most; then the contact stays.
///
/// Deterministic; without deviation the plan as it is.
/// @param plan  located on the object (PlanCheck::located); its goal is left as it is.
[[nodiscard]] plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                                         const ContactNoise& noise, RandomStream& random);

inline constexpr int kMostNoiseDraws = 100;

}  // namespace regrasp::sim
