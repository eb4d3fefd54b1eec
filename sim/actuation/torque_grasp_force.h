#pragma once

#include <optional>
#include <vector>

#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "planner/planning/in_hand_task.h"
#include "sim/actuation/hand_engine.h"

namespace regrasp::sim {

/// Return the grasp force of each static grasp of a plan, newtons (StaticGraspForce with
/// LargestGraspForce).
/// @param world    world of hand and object; its state changes to the static grasps.
/// @param entries  number of entries of the plan that count, initial grasp included.
[[nodiscard]] std::vector<double> ComputeGraspForcesOfPlan(HandEngine& world,
                                                           const object::Polyhedron& solid,
                                                           const plan::Plan& plan, int entries,
                                                           double friction_angle, double weight);

/// Return the grasp force of a static grasp, newtons.
/// It is the largest, up to `most`, that satisfies two conditions:
///
/// - No actuator needs more than kTorqueShare of its limit.
/// - The grasp keeps kStableShare of its stiffness without forces (ComputeGraspStiffness). Large
///   forces on soft servos buckle.
///
/// If only a grasp force below that of a force margin of kLeastMargin is stable, the result is the
/// force with this margin instead. The replay then decides.
/// @param grasp  contacts in the object's units, `scale` metres each.
/// @param may_be_supported  whether the grasp may hold the object by its weight. The force is then
///     an upper bound of the sum of its normal forces (grasp::ComputeSupportForces).
[[nodiscard]] double StaticGraspForce(HandEngine& world, const object::Polyhedron& solid,
                                      double scale, const plan::HandState& state,
                                      const plan::FingerGrasp& grasp, double friction_angle,
                                      double weight, double most, bool may_be_supported = false);

/// Return the largest grasp force of any static grasp, newtons.
/// It is kMostWeights times the weight and at least kEnough.
[[nodiscard]] double LargestGraspForce(double weight);

/// Return the grasp force that the static grasp after an entry of a plan requires, and the one that
/// the actuators exert.
/// The required force is the least one at which the grasp supports the weight with a force margin
/// of kLeastMargin. The available force is the largest one at which no actuator needs more than
/// kTorqueShare of its limit. Both are accurate to 2 % of the weight, and at most 20 weights.
/// @param world  world of hand and object; its state changes to the static grasp.
/// @returns nullopt if no such grasp force supports the weight.
[[nodiscard]] std::optional<planning::GraspForceNeed> ComputeGraspForceNeed(
    HandEngine& world, const object::Polyhedron& solid, const plan::Plan& plan,
    plan::EntryIndex entry, double friction_angle, double weight);

inline constexpr double kTorqueShare = 0.4;
inline constexpr double kStableShare = 0.5;
inline constexpr double kLeastMargin = 0.1;  ///< share of the mean normal force
inline constexpr double kMostWeights = 9;
inline constexpr double kEnough = 5;  ///< newtons

}  // namespace regrasp::sim
