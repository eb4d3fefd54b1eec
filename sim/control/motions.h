#pragma once

#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/plan/plan.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// One force per finger of the world, newtons in S on the object; zero for those that do not push.
using HandForces = std::vector<Eigen::Vector3d>;

/// Forces with which `fingers` hold the object against its weight and `load_S` together, at the
/// contacts as measured, with the full squeeze and the largest margin in their cones; the best
/// effort where there are none.
/// @param load_S  about the centroid, besides the weight.
[[nodiscard]] HandForces PlanHandForces(const ReplayWorld& world,
                                        const std::vector<FingerIndex>& fingers,
                                        const grasp::Wrench& load_S, double half_angle);

/// The forces that the fingers push with now.
[[nodiscard]] HandForces CurrentForces(const ReplayWorld& world);

/// Sets forces on the straight line between two: mixtures of balanced forces are balanced.
void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share);

/// The fingers appear at their contacts and take the object: squeeze and weight grow together.
void TakeHold(ReplayWorld& world, const plan::FingerGrasp& grasp_B);

/// Free fingers come down along the normals, all at once: quickly to kApproachGap, then ever slower
/// until each feels a force of kTouchForce; there it is anchored.
void PlaceFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B);

/// Forces change, on a straight line, into those with which `fingers` hold the object.
void TransferForces(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Forces change into these in kTransferTime.
void BlendForces(ReplayWorld& world, const HandForces& to);

/// Fingers that push with no force go back along the normals.
void RetractFingers(ReplayWorld& world, const std::vector<FingerIndex>& fingers);

/// Place, transfer to the grasp without the released fingers, retract.
void SwitchFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B,
                   const std::vector<FingerIndex>& released);

/// Lengths over D, forces over the squeeze, durations in natural times (ReplaySettings).
inline constexpr double kStandOff = 0.05;     ///< where a free finger waits before and after
inline constexpr double kFirstDepth = 1e-9;   ///< so that all fingers of the hold touch at once
inline constexpr double kApproachGap = 2e-3;  ///< 0.2 mm on a body of 10 cm
inline constexpr double kCreepGap = 2e-5;
inline constexpr double kCreepSpeed = 5e-5;  ///< a touch at this speed jolts less than 1e-4 F
inline constexpr double kTouchForce = 2e-4;  ///< 0.01 N at a squeeze of 50 N
inline constexpr double kHoldTime = 2;
inline constexpr double kApproachTime = 1.2;
inline constexpr double kCloseTime = 1.2;
inline constexpr double kMostCreepTime = 24;  ///< past the tolerance for the object's motion
inline constexpr double kTransferTime = 1.6;
inline constexpr double kRetractTime = 1.2;

}  // namespace regrasp::sim
