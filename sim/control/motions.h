#pragma once

#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Force on the object per finger of the world, newtons in S; zero for fingers without a force.
using HandForces = std::vector<Eigen::Vector3d>;

/// Plan forces with which `fingers` balance the object's weight and `load_S` together.
/// They apply at the measured contacts, with the full grasp force and the largest margin inside
/// their cones. If there are none, the result is the best approximation of ComputeGraspForces.
/// @param load_S  load about the centroid, in addition to the weight.
[[nodiscard]] HandForces PlanHandForces(const ReplayWorld& world,
                                        const std::vector<FingerIndex>& fingers,
                                        const grasp::Wrench& load_S, double friction_angle);

/// Return the current forces of the fingers.
[[nodiscard]] HandForces CurrentForces(const ReplayWorld& world);

/// Set forces between two sets of forces.
/// Linear interpolation, because combinations of balanced forces are balanced.
void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share);

/// Place the fingers at their contacts and take hold of the object.
/// Grasp force and weight grow together.
void TakeHold(ReplayWorld& world, const plan::FingerGrasp& grasp_B);

/// Move free fingers along the normals to their contacts, all at once.
/// They move quickly to kApproachGap, then increasingly slowly until each measures a force of
/// kTouchForce. It is anchored there.
void PlaceFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B);

/// Change the forces linearly into those with which `fingers` hold the object.
void TransferForces(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Change the forces linearly into the given ones in kTransferTime.
void BlendForces(ReplayWorld& world, const HandForces& to);

/// Move fingers without force away along the normals.
void RetractFingers(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Place fingers, transfer the forces to the grasp without the released fingers, and retract those.
void SwitchFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B,
                   const std::vector<FingerIndex>& released);

/// Lengths are over D, forces over the grasp force, durations in characteristic times
/// (ReplaySettings).
inline constexpr double kStandOff = 0.05;  ///< distance of a free finger before and after contact
/// Initial depth, so that all fingers of the initial grasp make contact at once.
inline constexpr double kFirstDepth = 1e-9;
inline constexpr double kApproachGap = 2e-3;  ///< 0.2 mm for an object of 10 cm
inline constexpr double kCreepGap = 2e-5;
/// Contact at this speed causes an impact below 1e-4 F.
inline constexpr double kCreepSpeed = 5e-5;
inline constexpr double kTouchForce = 2e-4;  ///< 0.01 N at a grasp force of 50 N
inline constexpr double kHoldTime = 2;
inline constexpr double kApproachTime = 1.2;
inline constexpr double kCloseTime = 1.2;
/// The creep then exceeds the tolerance of the object's motion.
inline constexpr double kMostCreepTime = 24;
inline constexpr double kTransferTime = 1.6;
inline constexpr double kRetractTime = 1.2;

}  // namespace regrasp::sim
