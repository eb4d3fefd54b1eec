#include "planner/grasp/load_resistance.h"

#include <cmath>
#include <stdexcept>

#include "planner/grasp/growing_ball.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

template <int kDim>
QualityBounds BoundLoaded(const UnitContacts& units, const Wrench& load, double friction,
                          const BallGoal& goal) {
  Eigen::Matrix<double, kDim, 1> vector;
  if constexpr (kDim == 6) {
    vector << load.force, load.torque_over_radius;
  } else {
    vector << load.force.x(), load.force.y(), load.torque_over_radius.z();
  }
  // Rounding that breaks every hull proves nothing.
  const double most = vector.norm() + std::hypot(1, friction);
  return GrowBall<kDim>(units, vector, friction, goal).value_or(QualityBounds{0, most, 0});
}

/// Bound the resistance in units of the total normal force.
QualityBounds BoundResistance(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                              double friction_angle, const Wrench& load, double total_normal,
                              const BallGoal& goal) {
  CheckGrasp(contacts, frame);
  CheckFrictionAngle(friction_angle);
  if (!(total_normal > 0) || !std::isfinite(total_normal)) {
    throw std::invalid_argument("load resistance: the total normal force must be positive");
  }
  if (!load.force.allFinite() || !load.torque_over_radius.allFinite()) {
    throw std::invalid_argument("load resistance: the load must be finite");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  const Wrench unit_load{load.force / total_normal, load.torque_over_radius / total_normal};
  const double friction = std::tan(friction_angle);
  return frame.dimension == 3 ? BoundLoaded<6>(units, unit_load, friction, goal)
                              : BoundLoaded<3>(units, unit_load, friction, goal);
}

}  // namespace

LoadResistance BoundLoadResistance(std::span<const Contact> contacts,
                                   const object::WrenchFrame& frame, double friction_angle,
                                   const Wrench& load, double total_normal, double relative_gap) {
  if (!(relative_gap >= kLeastRelativeGap)) {
    throw std::invalid_argument("load resistance: the relative gap must be at least 1e-5");
  }
  const QualityBounds bounds =
      BoundResistance(contacts, frame, friction_angle, load, total_normal, {relative_gap});
  return {total_normal * bounds.lower, total_normal * bounds.upper};
}

bool ResistsLoad(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                 double friction_angle, const Wrench& load, double total_normal,
                 double disturbance) {
  if (!(disturbance > 0) || !std::isfinite(disturbance)) {
    throw std::invalid_argument("load resistance: the disturbance must be positive");
  }
  constexpr double kGap = 1e-3;
  const double least = disturbance / total_normal;
  return BoundResistance(contacts, frame, friction_angle, load, total_normal, {kGap, least})
             .lower >= least;
}

}  // namespace regrasp::grasp
