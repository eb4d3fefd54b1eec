#include "planner/grasp/grasp_forces.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {
namespace {

/// A wrench within this of zero, relative to the total normal force, is balanced: rounding of the
/// simplex, a thousandth of what a force sensor could tell.
constexpr double kBalanced = 1e-10;

/// The margin is found to this, as a fraction of the mean normal force; forces vary as its root.
constexpr double kMarginGap = 1e-9;

template <int kDim>
typename WrenchSimplex<kDim>::Vector ToVector(const Eigen::Vector3d& force,
                                              const Eigen::Vector3d& torque) {
  if constexpr (kDim == 6) {
    return {force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z()};
  } else {
    return {force.x(), force.y(), torque.z()};
  }
}

/// All forces in units of the total normal force.
template <int kDim>
GraspForces Solve(const UnitContacts& contacts, const Wrench& load) {
  using Simplex = WrenchSimplex<kDim>;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  const double share = 1 / static_cast<double>(contacts.size());
  for (const UnitContact& contact : contacts) {
    force += share * contact.n;
    torque += share * contact.q.cross(contact.n);
  }
  Simplex simplex(contacts, ToVector<kDim>(-load.force, -load.torque_over_radius));
  simplex.FindWeights(/*stop_early=*/false);

  GraspForces result;
  result.balanced = simplex.unbalanced() <= kBalanced;
  if (result.balanced) {
    result.margin = simplex.Maximise(ToVector<kDim>(force, torque), 1, {.gap = kMarginGap}).lower;
  } else {
    simplex.FindNearest();
    result.margin = -simplex.unbalanced();
  }
  const double inset = std::max(result.margin, 0.0) * share;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    result.forces.push_back(simplex.ForceOf(static_cast<int>(i)) + inset * contacts[i].n);
    result.torques.push_back(simplex.TorqueOf(static_cast<int>(i)));
  }
  return result;
}

}  // namespace

GraspForces ComputeGraspForces(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                               double half_angle, const Wrench& load, double total_normal) {
  CheckGrasp(contacts, frame);
  CheckHalfAngle(half_angle);
  if (!(total_normal > 0) || !std::isfinite(total_normal)) {
    throw std::invalid_argument("grasp forces: the total normal force is not positive");
  }
  if (!load.force.allFinite() || !load.torque_over_radius.allFinite()) {
    throw std::invalid_argument("grasp forces: the load is not finite");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, half_angle);
  const Wrench unit_load{load.force / total_normal, load.torque_over_radius / total_normal};
  GraspForces result =
      frame.dimension == 3 ? Solve<6>(units, unit_load) : Solve<3>(units, unit_load);
  for (Eigen::Vector3d& force : result.forces) force *= total_normal;
  for (double& torque : result.torques) torque *= total_normal * frame.radius;
  return result;
}

}  // namespace regrasp::grasp
