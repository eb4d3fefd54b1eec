#include "planner/grasp/sliding_forces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace regrasp::grasp {
namespace {

/// Between normal forces that are tried.
constexpr double kForceFactor = 1.5;
/// Of the interval about the best of these, each to 0.62 of it.
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
    result = ComputeGraspForces(others, frame, friction.half_angle, sum, left);
  }
  auto next = result.forces.begin();
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    if (!slides[i]) pushed[i] = *next++;
  }
  result.forces = std::move(pushed);
  // Friction that drags has nothing left to twist with.
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
  // Golden section about the best.
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

}  // namespace regrasp::grasp
