#include "sim/actuation/joint_couplings.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "planner/kinematics/derive_couplings.h"

namespace regrasp::sim {
namespace {

bool IsRevolute(const mjModel& model, int joint) { return model.jnt_type[joint] == mjJNT_HINGE; }

/// Return whether a tendon uses revolute joints only.
bool SumsAngles(const mjModel& model, int tendon) {
  const int first = model.tendon_adr[tendon];
  for (int i = first; i < first + model.tendon_num[tendon]; ++i) {
    if (model.wrap_type[i] != mjWRAP_JOINT || !IsRevolute(model, model.wrap_objid[i])) return false;
  }
  return true;
}

/// Return the largest coefficient of a tendon, which converts a length to an angle.
double LargestCoefficient(const mjModel& model, int tendon) {
  double largest = 0;
  const int first = model.tendon_adr[tendon];
  for (int i = first; i < first + model.tendon_num[tendon]; ++i) {
    largest = std::max(largest, std::abs(model.wrap_prm[i]));
  }
  return largest;
}

/// Return MuJoCo's polynomial of the second joint or tendon.
double Polynomial(const mjModel& model, int equality, double x) {
  const mjtNum* c = model.eq_data + std::ptrdiff_t{mjNEQDATA} * equality;
  return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])));
}

/// Return the angle of a joint relative to the reference configuration.
double AngleFromRest(const mjModel& model, const mjData& data, int joint) {
  const int at = model.jnt_qposadr[joint];
  return data.qpos[at] - model.qpos0[at];
}

}  // namespace

JointCouplings::JointCouplings(const mjModel& model) {
  for (int i = 0; i < model.neq; ++i) {
    if (model.eq_active[i] == 0) continue;
    const int first = model.eq_obj1id[i];
    const int second = model.eq_obj2id[i];
    if (model.eq_type[i] == mjEQ_JOINT && IsRevolute(model, first) &&
        (second < 0 || IsRevolute(model, second))) {
      joints_.push_back(i);
    }
    if (model.eq_type[i] == mjEQ_TENDON && SumsAngles(model, first) &&
        LargestCoefficient(model, first) > 0 && (second < 0 || SumsAngles(model, second))) {
      tendons_.push_back(i);
    }
  }
}

JointCouplings::Residual JointCouplings::Largest(const mjModel& model, const mjData& data) const {
  Residual largest;
  const auto take = [&](int equality, double rad) {
    if (largest.equality < 0 || rad > largest.rad) largest = {equality, rad};
  };
  for (const int i : joints_) {
    const int second = model.eq_obj2id[i];
    const double x = second < 0 ? 0 : AngleFromRest(model, data, second);
    const double angle = AngleFromRest(model, data, model.eq_obj1id[i]);
    take(i, std::abs(angle - Polynomial(model, i, x)));
  }
  for (const int i : tendons_) {
    const auto stretch = [&](int tendon) {
      return data.ten_length[tendon] - model.tendon_length0[tendon];
    };
    const int first = model.eq_obj1id[i];
    const int second = model.eq_obj2id[i];
    const double off = stretch(first) - Polynomial(model, i, second < 0 ? 0 : stretch(second));
    take(i, std::abs(off) / LargestCoefficient(model, first));
  }
  return largest;
}

int JointCouplings::JointOf(const mjModel& model, int equality) const {
  const int first = model.eq_obj1id[equality];
  return model.eq_type[equality] == mjEQ_JOINT ? first : model.wrap_objid[model.tendon_adr[first]];
}

std::string JointCouplings::TextOf(const mjModel& model, int equality) const {
  const std::string joint = "joint " + kinematics::JointName(model, JointOf(model, equality));
  if (model.eq_type[equality] != mjEQ_JOINT) return joint + ", which the model couples by tendons,";
  const int second = model.eq_obj2id[equality];
  if (second < 0) return joint + ", which the model fixes,";
  return joint + ", which is coupled to " + kinematics::JointName(model, second) + ",";
}

}  // namespace regrasp::sim
