#include "sim/scene/damped_step.h"

#include <mujoco/mujoco.h>

#include <cstddef>

namespace regrasp::sim {
namespace {

/// Add h gain mᵀm to the inertia, where m is a row of moments.
/// The inertia has entries only for pairs of degrees of freedom of one chain of bodies.
void AddGain(const mjModel& model, double gain, const mjtNum* moment, mjData& data) {
  for (int i = 0; i < model.nv; ++i) {
    if (moment[i] == 0) continue;
    mjtNum* entry = data.qM + model.dof_Madr[i];
    for (int j = i; j >= 0; j = model.dof_parentid[j]) {
      *entry++ += model.opt.timestep * gain * moment[i] * moment[j];
    }
  }
}

void AddDampingToInertia(const mjModel& model, mjData& data) {
  for (int i = 0; i < model.nv; ++i) {
    data.qM[model.dof_Madr[i]] += model.opt.timestep * model.dof_damping[i];
  }
  for (int actuator = 0; actuator < model.nu; ++actuator) {
    if (model.actuator_biastype[actuator] != mjBIAS_AFFINE) continue;
    const double gain = -model.actuator_biasprm[std::ptrdiff_t{mjNBIAS} * actuator + 2];
    if (gain <= 0) continue;
    AddGain(model, gain, data.actuator_moment + std::ptrdiff_t{actuator} * model.nv, data);
  }
}

void Integrate(const mjModel& model, mjData& data) {
  const double h = model.opt.timestep;
  mju_addToScl(data.qvel, data.qacc, h, model.nv);
  mj_integratePos(&model, data.qpos, data.qvel, h);
  mju_copy(data.qacc_warmstart, data.qacc, model.nv);
  data.time += h;
}

}  // namespace

void DampedStep(const mjModel& model, mjData& data, const std::function<void()>& add_contacts) {
  const mjModel* m = &model;
  mjData* d = &data;
  const bool has_states = model.na > 0;
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_tendon(m, d);
  mj_transmission(m, d);
  mj_crb(m, d);
  if (!has_states) AddDampingToInertia(model, data);
  mj_factorM(m, d);
  mj_collision(m, d);
  if (add_contacts) add_contacts();
  mj_makeConstraint(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  if (has_states) {
    mj_step2(m, d);
    return;
  }
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
  mj_checkAcc(m, d);
  Integrate(model, data);
}

}  // namespace regrasp::sim
