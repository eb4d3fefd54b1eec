#include "sim/actuation/scene_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace regrasp::sim {
namespace {

/// Ratio of frictional to normal constraint impedance (impratio), so that sticking contacts creep
/// little.
constexpr double kFrictionHardness = 100;
/// Ratio of TipContactModel::kDefault, as in the hands of MuJoCo Menagerie.
constexpr double kDefaultFrictionHardness = 10;
/// Armature of frozen joints, kg m², and their damping, N·m·s/rad. A torque of 1 N·m moves such a
/// joint by less than 1e-4 rad in a minute. The armature alone would let it fall by 1.8 rad.
constexpr double kFrozenArmature = 1e3;
constexpr double kFrozenDamping = 1e6;

}  // namespace

void FreezeJoints(const std::vector<int>& joints, mjModel& model) {
  for (const int joint : joints) {
    model.dof_armature[model.jnt_dofadr[joint]] += kFrozenArmature;
    model.dof_damping[model.jnt_dofadr[joint]] += kFrozenDamping;
  }
}

void SetReplayOptions(const Eigen::Vector3d& gravity, const HandPhysics& physics,
                      const std::vector<int>& frozen, mjModel& model) {
  const bool implicit = model.opt.integrator == mjINT_IMPLICIT;
  mj_defaultOption(&model.opt);
  model.opt.integrator = implicit ? mjINT_IMPLICIT : mjINT_EULER;
  model.opt.timestep = physics.timestep_s;
  model.opt.cone = physics.pyramidal_cones ? mjCONE_PYRAMIDAL : mjCONE_ELLIPTIC;
  model.opt.impratio =
      physics.contacts == TipContactModel::kStiff ? kFrictionHardness : kDefaultFrictionHardness;
  std::copy_n(gravity.data(), 3, model.opt.gravity);
  // The solver's tolerance is relative to the mean inertia, which frozen joints would dominate.
  const double mean = model.stat.meaninertia;
  const double moving = mean - kFrozenArmature * static_cast<double>(frozen.size()) / model.nv;
  if (!frozen.empty() && mean > 0) model.opt.tolerance *= std::max(moving, mjMINVAL) / mean;
}

void UpdateConstants(mjModel& model, mjData& data) {
  mj_setConst(&model, &data);
  mj_resetData(&model, &data);
  mj_forward(&model, &data);
}

}  // namespace regrasp::sim
