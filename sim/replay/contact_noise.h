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
/// is moved along the surface by a normal deviate in each direction of its face, straight and
/// across borders (object/surface_walk.h), so that it does not matter how small faces are. It has
/// the normal of the face that it comes to.
///
/// A finger is off by one draw as long as it is to stay at a point, through rests and aligns and
/// when its normal is to turn there; whenever it comes to another point it is drawn anew. In an
/// align it goes along the surface from one place to the next, which can add waypoints. A draw
/// where no ball of the fingertip's radius fits, or to which no way is found, is drawn again,
/// kMostNoiseDraws times at most; then the contact stays.
///
/// Deterministic; without deviation the plan as it is.
/// @param plan  located on the object (PlanCheck::located); its goal is left as it is.
[[nodiscard]] plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                                         const ContactNoise& noise, RandomStream& random);

inline constexpr int kMostNoiseDraws = 100;

}  // namespace regrasp::sim
