#pragma once

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// Return the grasp force with which a hand holds an object, newtons.
/// It is the largest that kTorqueShare of the limits of its actuators allows in every static grasp
/// of the plan, and at most MostSqueeze.
/// @param world    world of hand and object; its state changes to the static grasps.
/// @param entries  number of entries of the plan that count, initial grasp included.
[[nodiscard]] double TorqueSqueeze(HandWorld& world, const object::Polyhedron& solid,
                                   const plan::Plan& plan, int entries, double half_angle,
                                   double weight);

/// Return the grasp force for a single static grasp, newtons.
/// It is the largest that kTorqueShare allows, and at most `most`.
/// @param grasp  contacts in the object's units, `scale` metres each.
[[nodiscard]] double RestSqueeze(HandWorld& world, const object::Polyhedron& solid, double scale,
                                 const plan::HandState& state, const plan::FingerGrasp& grasp,
                                 double half_angle, double weight, double most);

/// Return the largest grasp force of any static grasp, newtons.
/// It is kMostWeights times the weight, or kMostWeightsOfUnknown times it if the hand's model omits
/// the force limit of any actuator. It is at least kEnough.
[[nodiscard]] double MostSqueeze(const HandWorld& world, double weight);

inline constexpr double kTorqueShare = 0.4;
inline constexpr double kMostWeights = 12;
inline constexpr double kMostWeightsOfUnknown = 6;  ///< for a hand of unknown strength
inline constexpr double kEnough = 4;                ///< newtons

}  // namespace regrasp::sim
