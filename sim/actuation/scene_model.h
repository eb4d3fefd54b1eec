#pragma once

#include <Eigen/Core>
#include <vector>

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// Let joints of no finger stay where they are: an armature that no torque of a hand moves.
/// @param joints  Revolute and prismatic joints of the model.
void FreezeJoints(const std::vector<int>& joints, mjModel_& model);

/// Set all options of the simulation: those of the hand's model, such as disabled limits, must not
/// decide. An implicit integrator is kept; the constraint solver is as precise as MuJoCo's defaults
/// make it for the hand without frozen joints.
/// @param gravity  In the engine's world, m/s².
void SetReplayOptions(const Eigen::Vector3d& gravity, const std::vector<int>& frozen,
                      mjModel_& model);

/// Recompute all constants of a model that depend on others (mj_setConst), such as the inverse
/// inertias that say how hard constraints are. To be called after every change of a model.
/// @param data  Is at rest (qpos0) then.
void UpdateConstants(mjModel_& model, mjData_& data);

}  // namespace regrasp::sim
