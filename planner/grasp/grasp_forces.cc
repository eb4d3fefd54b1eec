#include "planner/grasp/grasp_forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

namespace {

/// Wrench, relative to the total normal force, below which forces count as balanced: rounding of
/// the simplex, a thousandth of the resolution of a force sensor.
constexpr double kBalanced = 1e-10;

/// Gap of the margin, as a fraction of the mean normal force; the error of forces is proportional
/// to its square root.
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

/// Sum of the normal forces.
enum class NormalSum {
  kTotal,   ///< the total normal force
  kAtMost,  ///< at most the total normal force
};

/// Return contacts with one more, which applies no wrench. It takes the part of the total normal
/// force that the others do not use.
UnitContacts WithSlack(UnitContacts contacts) {
  contacts.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 0, 0});
  return contacts;
}

/// Compute forces in units of the total normal force.
template <int kDim>
GraspForces Solve(const UnitContacts& contacts, const Wrench& load, NormalSum sum) {
  using Simplex = WrenchSimplex<kDim>;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  const double share = 1 / static_cast<double>(contacts.size());
  for (const UnitContact& contact : contacts) {
    force += share * contact.n;
    torque += share * contact.q.cross(contact.n);
  }
  const UnitContacts columns = sum == NormalSum::kAtMost ? WithSlack(contacts) : contacts;
  Simplex simplex(columns, ToVector<kDim>(-load.force, -load.torque_over_radius));
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

GraspForces ComputeForces(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                          double friction_angle, const Wrench& load, double total_normal,
                          NormalSum sum) {
  CheckGrasp(contacts, frame);
  CheckFrictionAngle(friction_angle);
  if (!(total_normal > 0) || !std::isfinite(total_normal)) {
    throw std::invalid_argument("grasp forces: the total normal force must be positive");
  }
  if (!load.force.allFinite() || !load.torque_over_radius.allFinite()) {
    throw std::invalid_argument("grasp forces: the load must be finite");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  const Wrench unit_load{load.force / total_normal, load.torque_over_radius / total_normal};
  GraspForces result =
      frame.dimension == 3 ? Solve<6>(units, unit_load, sum) : Solve<3>(units, unit_load, sum);
  for (Eigen::Vector3d& force : result.forces) force *= total_normal;
  for (double& torque : result.torques) torque *= total_normal * frame.radius;
  return result;
}

}  // namespace

GraspForces ComputeGraspForces(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                               double friction_angle, const Wrench& load, double total_normal) {
  return ComputeForces(contacts, frame, friction_angle, load, total_normal, NormalSum::kTotal);
}

GraspForces ComputeSupportForces(std::span<const Contact> contacts,
                                 const object::WrenchFrame& frame, double friction_angle,
                                 const Wrench& load, double most_normal) {
  return ComputeForces(contacts, frame, friction_angle, load, most_normal, NormalSum::kAtMost);
}

namespace {

/// Factor between consecutive normal forces of the search.
constexpr double kForceFactor = 1.5;
/// Number of golden-section steps about the best force; each reduces the interval to 0.62 of its
/// length.
constexpr int kNarrowings = 16;

}  // namespace

GraspForces ComputeSlidingForces(const Grasp& grasp, std::span<const SlidingContact> sliding,
                                 const object::WrenchFrame& frame, const SlidingFriction& friction,
                                 const Wrench& load, double total_normal, double sliding_normal) {
  std::vector<Eigen::Vector3d> pushed(grasp.size(), Eigen::Vector3d::Zero());
  std::vector<bool> slides(grasp.size(), false);
  Wrench sum = load;
  double left = total_normal;
  for (const SlidingContact& one : sliding) {
    const Contact& contact = grasp[one.contact];
    const Eigen::Vector3d force = sliding_normal * (contact.n + friction.mu * one.direction);
    pushed[one.contact] = force;
    slides[one.contact] = true;
    sum.force += force;
    sum.torque_over_radius += (contact.p - frame.origin).cross(force) / frame.radius;
    left -= sliding_normal;
  }
  Grasp others;
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    if (!slides[i]) others.push_back(grasp[i]);
  }
  GraspForces result;
  if (others.empty()) {
    result.margin = -(sum.force.lpNorm<1>() + sum.torque_over_radius.lpNorm<1>()) / total_normal;
  } else {
    result = ComputeGraspForces(others, frame, friction.friction_angle, sum, left);
  }
  auto next = result.forces.begin();
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    if (!slides[i]) pushed[i] = *next++;
  }
  result.forces = std::move(pushed);
  // A sliding contact uses all its friction and cannot apply a torque.
  std::vector<double> torques(grasp.size(), 0.0);
  auto next_torque = result.torques.begin();
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    if (!slides[i]) torques[i] = *next_torque++;
  }
  result.torques = std::move(torques);
  return result;
}

SlidingNormal ChooseSlidingNormal(double least, double most,
                                  const std::function<double(double)>& margin) {
  SlidingNormal best{least, margin(least)};
  for (double normal = least * kForceFactor; normal <= most && best.margin < kGoodSlidingMargin;
       normal *= kForceFactor) {
    const SlidingNormal tried{normal, margin(normal)};
    if (tried.margin > best.margin) best = tried;
  }
  if (best.margin >= kGoodSlidingMargin) return best;
  // Golden-section search about the best force.
  double low = std::max(least, best.normal / kForceFactor);
  double high = std::min(most, best.normal * kForceFactor);
  for (int i = 0; i < kNarrowings; ++i) {
    const SlidingNormal a{high - (high - low) / std::numbers::phi,
                          margin(high - (high - low) / std::numbers::phi)};
    const SlidingNormal b{low + (high - low) / std::numbers::phi,
                          margin(low + (high - low) / std::numbers::phi)};
    (a.margin >= b.margin ? high : low) = a.margin >= b.margin ? b.normal : a.normal;
    for (const SlidingNormal& tried : {a, b}) {
      if (tried.margin > best.margin) best = tried;
    }
  }
  return best;
}

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
    throw std::invalid_argument("largest load: the total normal force must be positive");
  }
  for (const Wrench* wrench : {&load, &direction}) {
    if (!wrench->force.allFinite() || !wrench->torque_over_radius.allFinite()) {
      throw std::invalid_argument("largest load: wrenches must be finite");
    }
  }
  if (direction.force.isZero(0) && direction.torque_over_radius.isZero(0)) {
    throw std::invalid_argument("largest load: the direction must not be zero");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  const Wrench unit_load{load.force / total_normal, load.torque_over_radius / total_normal};
  return frame.dimension == 3 ? SolveLargestLoad<6>(units, unit_load, direction)
                              : SolveLargestLoad<3>(units, unit_load, direction);
}

}  // namespace regrasp::grasp
