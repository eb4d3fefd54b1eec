#include "planner/grasp/largest_load.h"

#include <cmath>
#include <stdexcept>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {
namespace {

/// Gap of the largest load, over the total normal force.
constexpr double kLoadGap = 1e-9;

/// Unbalanced wrench that counts as rounding of the simplex, as in ComputeGraspForces.
constexpr double kLoadBalanced = 1e-10;

template <int kDim>
typename WrenchSimplex<kDim>::Vector ToVector(const Wrench& wrench) {
  const Eigen::Vector3d& f = wrench.force;
  const Eigen::Vector3d& t = wrench.torque_over_radius;
  if constexpr (kDim == 6) {
    return {f.x(), f.y(), f.z(), t.x(), t.y(), t.z()};
  } else {
    return {f.x(), f.y(), t.z()};
  }
}

/// Compute the largest load in units of the total normal force.
template <int kDim>
std::optional<QualityBounds> SolveLargestLoad(const UnitContacts& contacts, const Wrench& load,
                                              const Wrench& direction) {
  const Wrench target{-load.force, -load.torque_over_radius};
  WrenchSimplex<kDim> simplex(contacts, ToVector<kDim>(target));
  simplex.FindWeights(/*stop_early=*/false);
  if (simplex.unbalanced() > kLoadBalanced) return std::nullopt;
  const auto found = simplex.Maximise(ToVector<kDim>(direction), 0, {.gap = kLoadGap});
  return QualityBounds{found.lower, found.upper};
}

}  // namespace

std::optional<QualityBounds> ComputeLargestLoad(std::span<const Contact> contacts,
                                                const object::WrenchFrame& frame,
                                                double friction_angle, const Wrench& load,
                                                const Wrench& direction, double total_normal) {
  CheckGrasp(contacts, frame);
  CheckFrictionAngle(friction_angle);
  if (!(total_normal > 0) || !std::isfinite(total_normal)) {
    throw std::invalid_argument("largest load: the total normal force is not positive");
  }
  for (const Wrench* wrench : {&load, &direction}) {
    if (!wrench->force.allFinite() || !wrench->torque_over_radius.allFinite()) {
      throw std::invalid_argument("largest load: a wrench is not finite");
    }
  }
  if (direction.force.isZero(0) && direction.torque_over_radius.isZero(0)) {
    throw std::invalid_argument("largest load: the direction is zero");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  const Wrench unit_load{load.force / total_normal, load.torque_over_radius / total_normal};
  return frame.dimension == 3 ? SolveLargestLoad<6>(units, unit_load, direction)
                              : SolveLargestLoad<3>(units, unit_load, direction);
}

}  // namespace regrasp::grasp
