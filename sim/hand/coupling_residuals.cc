#include "sim/hand/coupling_residuals.h"

#include <mujoco/mujoco.h>

#include <cmath>
#include <utility>

#include "planner/kinematics/mujoco_model.h"

namespace regrasp::sim {
namespace {

std::string NameOfJoint(const mjModel& model, int joint) {
  const char* name = mj_id2name(&model, mjOBJ_JOINT, joint);
  return name != nullptr ? name : std::to_string(joint);
}

}  // namespace

CouplingResiduals::CouplingResiduals(const kinematics::HandFile& file)
    : model_(*file.compiled->model) {
  AddEqualities();
  for (const kinematics::Mimic& mimic : file.compiled->text.mimics) {
    AddRelation(mimic.joint, mimic.follows, mimic.multiplier, mimic.offset,
                "<mimic> of joint " + mimic.joint);
  }
  for (const auto& coupling : file.description.couplings) {
    AddRelation(coupling.joint, coupling.follows, coupling.ratio, coupling.offset,
                "coupling of joint " + coupling.joint + " in the hand's file");
  }
}

void CouplingResiduals::AddRelation(const std::string& joint, const std::string& leader,
                                    double ratio, double offset, const std::string& source) {
  const int follower = mj_name2id(&model_, mjOBJ_JOINT, joint.c_str());
  const int other = mj_name2id(&model_, mjOBJ_JOINT, leader.c_str());
  if (follower < 0 || other < 0) return;
  equations_.push_back({{{follower, 1}, {other, -ratio}}, offset, source});
}

void CouplingResiduals::AddTendon(int tendon, double factor, Equation& equation) const {
  for (int i = 0; i < model_.tendon_num[tendon]; ++i) {
    const int wrap = model_.tendon_adr[tendon] + i;
    const int joint = model_.wrap_objid[wrap];
    const double coefficient = factor * model_.wrap_prm[wrap];
    equation.terms.push_back({joint, coefficient});
    equation.constant += coefficient * model_.qpos0[model_.jnt_qposadr[joint]];
  }
}

/// Add constraints relative to the positions of the reference configuration.
/// The hand reader rejects nonlinear terms, spatial tendons and loops.
void CouplingResiduals::AddEqualities() {
  const auto is_fixed = [&](int tendon) {
    return model_.wrap_type[model_.tendon_adr[tendon]] == mjWRAP_JOINT;
  };
  for (int i = 0; i < model_.neq; ++i) {
    if (model_.eq_active[i] == 0) continue;
    const mjtNum* polynomial = model_.eq_data + std::ptrdiff_t{mjNEQDATA} * i;
    const int first = model_.eq_obj1id[i];
    const int second = model_.eq_obj2id[i];
    Equation equation{{}, polynomial[0], ""};
    if (model_.eq_type[i] == mjEQ_JOINT) {
      equation.source = "equality constraint of joint " + NameOfJoint(model_, first);
      for (const auto& [joint, factor] : {std::pair(first, 1.0), {second, -polynomial[1]}}) {
        if (joint < 0) continue;
        equation.terms.push_back({joint, factor});
        equation.constant += factor * model_.qpos0[model_.jnt_qposadr[joint]];
      }
    } else if (model_.eq_type[i] == mjEQ_TENDON && is_fixed(first) &&
               (second < 0 || is_fixed(second))) {
      equation.source = "equality constraint of a tendon";
      AddTendon(first, 1, equation);
      if (second >= 0) AddTendon(second, -polynomial[1], equation);
    } else {
      continue;
    }
    equations_.push_back(std::move(equation));
  }
}

CouplingResiduals::Residual CouplingResiduals::Largest(const mjData& data) const {
  Residual largest;
  for (const Equation& equation : equations_) {
    double off = -equation.constant;
    for (const Term& term : equation.terms) {
      off += term.coefficient * data.qpos[model_.jnt_qposadr[term.joint]];
    }
    const double radians = std::abs(off / equation.terms.front().coefficient);
    if (largest.joint >= 0 && radians <= largest.radians) continue;
    largest = {equation.terms.front().joint, radians, equation.source};
  }
  return largest;
}

}  // namespace regrasp::sim
