#include "planner/plan/gravity_support.h"

#include <cmath>

#include "planner/base/number.h"

namespace regrasp::plan {
namespace {

/// Rotation below which an interval is not divided further, radians. Its load deviates from the
/// chord by 1e-7 weights.
constexpr double kFinestTurn = 1e-3;

/// Accuracy of required friction angles, radians.
constexpr double kAngleAccuracy = 1e-5;

double TurnBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  return Eigen::Quaterniond(from.linear()).angularDistance(Eigen::Quaterniond(to.linear()));
}

}  // namespace

grasp::Wrench WeightCarrier::WeightAt(const Eigen::Isometry3d& pose) const {
  return {-(pose.linear().transpose() * up_), Eigen::Vector3d::Zero()};
}

grasp::LoadResistance WeightCarrier::ResistanceAt(std::span<const grasp::Contact> contacts,
                                                  const Eigen::Isometry3d& pose) const {
  return grasp::BoundLoadResistance(contacts, frame_, friction_angle_, WeightAt(pose),
                                    support_.force);
}

bool WeightCarrier::ResistsAt(std::span<const grasp::Contact> contacts,
                              const Eigen::Isometry3d& pose, double disturbance,
                              double friction_angle) const {
  return grasp::ResistsLoad(contacts, frame_, friction_angle, WeightAt(pose), support_.force,
                            disturbance);
}

bool WeightCarrier::HoldsBetween(std::span<const grasp::Contact> contacts,
                                 const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  if (!HoldsAt(contacts, from) || !HoldsAt(contacts, to)) return false;
  const double turn = TurnBetween(from, to);
  const double required = support_.disturbance + 1 - std::cos(turn / 2);
  if (ResistsAt(contacts, from, required, friction_angle_) &&
      ResistsAt(contacts, to, required, friction_angle_)) {
    return true;
  }
  if (turn < kFinestTurn) return false;
  const Eigen::Isometry3d middle = StateBetween({from, {}}, {to, {}}, 0.5).pose;
  return HoldsBetween(contacts, from, middle) && HoldsBetween(contacts, middle, to);
}

bool WeightCarrier::HoldsAlong(std::span<const grasp::Contact> contacts,
                               std::span<const Eigen::Isometry3d> poses) const {
  if (!HoldsAt(contacts, poses.front())) return false;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    if (!HoldsBetween(contacts, poses[i], poses[i + 1])) return false;
  }
  return true;
}

grasp::RequiredFrictionAngle WeightCarrier::RequiredFrictionAngleAt(
    std::span<const grasp::Contact> contacts, const Eigen::Isometry3d& pose) const {
  grasp::RequiredFrictionAngle required{0, friction_angle_};
  while (required.upper - required.lower > kAngleAccuracy) {
    const double middle = (required.lower + required.upper) / 2;
    const bool holds = ResistsAt(contacts, pose, support_.disturbance, middle);
    (holds ? required.upper : required.lower) = middle;
  }
  return required;
}

}  // namespace regrasp::plan
