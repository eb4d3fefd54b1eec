#pragma once

#include <vector>

#include "planner/plan/plan.h"
#include "sim/control/grasp_control.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

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
