#include "planner/gait/rolling.h"

#include <span>
#include <utility>

#include "planner/grasp/grasp_forces.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

Eigen::Matrix3d FingertipOrientation(const kinematics::Finger& finger,
                                     const JointConfiguration& configuration,
                                     const Eigen::Isometry3d& pose) {
  return pose.linear().transpose() * kinematics::FramesOf(finger, configuration).back().linear();
}

SurfacePoint Rolled(const SurfacePoint& contact, const Eigen::Matrix3d& turn, double radius,
                    const collision::BallContact& surface) {
  const Eigen::AngleAxisd by(turn);
  const Eigen::Vector3d to_centre = -radius * contact.n;
  const Eigen::Vector3d centre = contact.p + to_centre + by.angle() * by.axis().cross(to_centre);
  const auto near = surface.Find(centre, 2 * radius);
  if (near.empty()) return contact;
  return {near.front().point, -near.front().outward};
}

bool RollingTips::AreGrasp(const RolledTips& tips, const Eigen::Isometry3d& pose) const {
  grasp::Grasp grasp;
  for (const auto& tip : tips) {
    if (tip) grasp.push_back({tip->contact.p / setup_.scale, tip->contact.n, {}});
  }
  criteria::KnownGrasp known;
  if (!memory_.GraspEvaluator::Admits(known, [&] { return std::span(std::as_const(grasp)); })) {
    return setup_.carrier != nullptr && setup_.carrier->HoldsAt(grasp, pose);
  }
  const grasp::Wrench weight{-(pose.linear().transpose() * setup_.scene.hand().up),
                             Eigen::Vector3d::Zero()};
  return grasp::ComputeGraspForces(grasp, memory_.frame(), memory_.friction_angle(), weight,
                                   kGraspForceOverWeight)
             .margin >= setup_.force_margin;
}

std::optional<RolledTip> RollingTips::Follow(FingerIndex finger, const RolledTip& tip,
                                             const Eigen::Isometry3d& from_pose,
                                             const Eigen::Isometry3d& to_pose) const {
  const kinematics::Finger& chain = setup_.scene.finger(finger);
  const auto configuration_at = [&](const SurfacePoint& contact, const JointConfiguration& near) {
    return setup_.inverse[finger].SolveFrom(TargetAt(chain, contact, to_pose), near);
  };
  const std::optional<JointConfiguration> unrolled =
      configuration_at(tip.contact, tip.configuration);
  if (!unrolled) return std::nullopt;
  const Eigen::Matrix3d turn =
      FingertipOrientation(chain, *unrolled, to_pose) *
      FingertipOrientation(chain, tip.configuration, from_pose).transpose();
  const SurfacePoint contact = Rolled(tip.contact, turn, chain.tip.radius, *setup_.rolled_on);
  std::optional<JointConfiguration> configuration = configuration_at(contact, *unrolled);
  if (!configuration) return std::nullopt;
  return RolledTip{contact, *std::move(configuration)};
}

bool RollingTips::AreClear(const RolledTips& tips, const Eigen::Isometry3d& pose,
                           const Stance& stance) const {
  std::vector<PlacedFinger> placed;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    const auto& tip = tips[finger];
    placed.push_back(setup_.scene.Place(finger, tip ? tip->configuration : stance.idle[finger]));
    if (tip && !setup_.scene.KeepsOffHand(placed.back())) return false;
    if (tip && !setup_.scene.KeepsOffObject(placed.back(), pose, TipContact::kTouching))
      return false;
    if (tip && !setup_.scene.IsShallow(placed.back(), pose, pose.linear() * tip->contact.n)) {
      return false;
    }
    for (std::size_t other = 0; other + 1 < placed.size(); ++other) {
      if (!setup_.scene.KeepApart(placed[other], placed.back())) return false;
    }
  }
  return true;
}

std::optional<RolledTips> RollingTips::Advance(const RolledTips& from,
                                               const Eigen::Isometry3d& from_pose,
                                               const Eigen::Isometry3d& to_pose,
                                               const Stance& stance) const {
  RolledTips to(from.size());
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    if (!from[finger]) continue;
    to[finger] = Follow(finger, *from[finger], from_pose, to_pose);
    if (!to[finger]) return std::nullopt;
  }
  if (!AreGrasp(to, to_pose) || !AreClear(to, to_pose, stance)) return std::nullopt;
  return to;
}

void AddRolled(const HandScene& scene, const RolledTips& tips, Surroundings& around) {
  if (tips.empty()) return;
  for (const PlacedFinger& other : around.others) {
    const auto& tip = tips[other.finger];
    around.rolled.push_back(tip ? scene.Place(other.finger, tip->configuration) : other);
  }
}

}  // namespace regrasp::gait
