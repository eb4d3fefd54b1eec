#pragma once

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// The sum of the normal forces with which a hand holds an object, newtons: as much as
/// kTorqueShare of the limits of its actuators allow in every rest of the plan, and no more than
/// MostSqueeze.
/// @param world    its hand and object are moved to the rests.
/// @param entries  how many of the plan count, the hold first.
[[nodiscard]] double TorqueSqueeze(HandWorld& world, const object::Polyhedron& solid,
                                   const plan::Plan& plan, int entries, double half_angle,
                                   double weight);

/// The same of a single rest: as much as kTorqueShare allows, and no more than `most`.
/// @param grasp  in the object's units, `scale` metres each.
[[nodiscard]] double RestSqueeze(HandWorld& world, const object::Polyhedron& solid, double scale,
                                 const plan::HandState& state, const plan::FingerGrasp& grasp,
                                 double half_angle, double weight, double most);

/// The largest grasp force of any rest, newtons: kMostWeights, kMostWeightsOfUnknown if the hand's
/// model leaves out the force limit of any actuator, or kEnough if that is more.
[[nodiscard]] double MostSqueeze(const HandWorld& world, double weight);

inline constexpr double kTorqueShare = 0.4;
inline constexpr double kMostWeights = 12;
inline constexpr double kMostWeightsOfUnknown = 6;  ///< of a hand of unknown strength
inline constexpr double kEnough = 4;                ///< newtons

}  // namespace regrasp::sim
