#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene/settings.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

/// Freeze joints of no finger by an armature and a damping that no torque of a hand moves.
/// @param joints  revolute and prismatic joints of the model.
void FreezeJoints(const std::vector<int>& joints, mjModel_& model);

/// Set all options of the simulation.
/// Options of the hand's model, such as disabled limits, must not decide a replay. Only an implicit
/// integrator is kept. The precision of the constraint solver is that of MuJoCo's defaults for the
/// hand without frozen joints.
/// @param gravity  gravity in the engine's world, m/s².
void SetReplayOptions(const Eigen::Vector3d& gravity, const HandPhysics& physics,
                      const std::vector<int>& frozen, mjModel_& model);

/// Recompute all constants of a model that depend on others (mj_setConst).
/// One example is the inverse inertias, which determine the stiffness of constraints. Call it after
/// every change of a model.
/// @param data  data of the model; its state becomes the reference configuration (qpos0).
void UpdateConstants(mjModel_& model, mjData_& data);

}  // namespace regrasp::sim
