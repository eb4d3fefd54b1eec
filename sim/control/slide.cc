#include "sim/control/slide.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/control/align.h"
#include "sim/control/grasp_control.h"
#include "sim/control/motions.h"
#include "sim/scene/align_path.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Normal forces that are tried for a sliding finger, over the squeeze: from the least upwards by
/// this factor.
constexpr double kForceFactor = 1.5;
constexpr double kLargestSlideForce = 0.5;

/// A slide whose others keep this share of the mean normal force inside their cones is good enough
/// that a smaller force of the sliding finger is not given up for more.
constexpr double kGoodMargin = 0.05;

/// Forces are planned anew after this share of D of travel.
constexpr double kSegment = 0.01;
constexpr double kLeastSegmentTime = 0.4;  ///< natural times

struct SlideForces {
  HandForces hand;
  double margin = 0;
};

/// Forces while `finger` slides towards `direction_B`, pressing with `normal`: the finger's is on
/// its cone's edge, the others balance it and the weight inside narrower cones.
SlideForces PlanSlide(const ReplayWorld& world, FingerIndex finger, const grasp::Contact& at_B,
                      const Vector3d& direction_B, double normal, double friction_share) {
  const double mu = world.settings().mu;
  const double radius = world.settings().diameter_m / 2;
  const Vector3d pushed_B = normal * (at_B.n + mu * direction_B);
  std::vector<FingerIndex> others = world.HoldingFingers();
  std::erase(others, finger);
  grasp::Grasp contacts;
  for (const FingerIndex f : others) {
    contacts.push_back({world.ContactPoint_B(f), world.fingers()[f].contact.n, {}});
  }
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  const grasp::Wrench load{R_SB.transpose() * world.weight_S() + pushed_B,
                           at_B.p.cross(pushed_B) / radius};
  const grasp::GraspForces planned =
      grasp::ComputeGraspForces(contacts, world.frame_B(), std::atan(friction_share * mu), load,
                                world.settings().squeeze_N - normal);
  SlideForces result{HandForces(world.fingers().size(), Vector3d::Zero()), planned.margin};
  for (std::size_t i = 0; i < others.size(); ++i) {
    result.hand[others[i]] = R_SB * planned.forces[i];
  }
  result.hand[finger] = R_SB * pushed_B;
  return result;
}

/// The smallest normal force with a good margin, or else the one with the best; with the whole
/// friction only where kSlideFriction of it leaves no margin.
SlideForces ChooseSlide(const ReplayWorld& world, FingerIndex finger, const grasp::Contact& at_B,
                        const Vector3d& direction_B) {
  std::optional<SlideForces> best;
  for (const double friction_share : {kSlideFriction, 1.0}) {
    for (double share = kSlideForce; share <= kLargestSlideForce; share *= kForceFactor) {
      SlideForces tried = PlanSlide(world, finger, at_B, direction_B,
                                    share * world.settings().squeeze_N, friction_share);
      if (!best || tried.margin > best->margin) best = std::move(tried);
      if (best->margin >= kGoodMargin) return *best;
    }
    if (best->margin > 0) return *best;
  }
  return *best;
}

Vector3d Direction(const grasp::Contact& from, const grasp::Contact& to) {
  const Vector3d path = to.p - from.p;
  const Vector3d along = path - path.dot(to.n) * to.n;
  return along.norm() > 0 ? Vector3d(along.normalized()) : Vector3d::Zero();
}

/// One straight segment of the path: tip and forces change together, at constant rates.
void MoveTip(ReplayWorld& world, FingerIndex finger, const grasp::Contact& from,
             const grasp::Contact& to, const HandForces& forces_after, double duration) {
  const HandForces forces_before = CurrentForces(world);
  WorldFinger& state = world.fingers()[finger];
  world.Run(duration, [&](double share) {
    state.contact = Interpolate({{finger, from}}, {{finger, to}}, share).front().contact;
    state.anchor_S = world.TipAt_S(state.contact, 0);
    MixForces(world, forces_before, forces_after, share);
  });
}

double TipTravel(const ReplayWorld& world, const grasp::Contact& from, const grasp::Contact& to) {
  const double turn = std::acos(std::clamp(from.n.dot(to.n), -1.0, 1.0));
  return (to.p - from.p).norm() + turn * world.settings().fingertip_radius_m;
}

}  // namespace

double SlideMargin(const ReplayWorld& world, FingerIndex finger, const grasp::Contact& from_B,
                   const grasp::Contact& to_B) {
  const Vector3d direction = Direction(from_B, to_B);
  return std::min(ChooseSlide(world, finger, from_B, direction).margin,
                  ChooseSlide(world, finger, to_B, direction).margin);
}

void SlideFinger(ReplayWorld& world, FingerIndex finger, const grasp::Contact& from_B,
                 const grasp::Contact& to_B) {
  const double travel = TipTravel(world, from_B, to_B) / world.settings().diameter_m;
  const int segments = std::max(1, static_cast<int>(std::ceil(travel / kSegment)));
  const double duration = std::max(kLeastSegmentTime, travel / (segments * kSlideSpeed));
  const Vector3d direction = Direction(from_B, to_B);
  WorldFinger& state = world.fingers()[finger];
  const SiteIndex site = FindSite(world.scene(), from_B, to_B);
  world.engine().AddSite(finger, site);
  BlendForces(world, ChooseSlide(world, finger, from_B, direction).hand);
  state.sliding = true;
  grasp::Contact at = from_B;
  for (int i = 1; i <= segments; ++i) {
    const double share = static_cast<double>(i) / segments;
    const grasp::Contact next =
        Interpolate({{finger, from_B}}, {{finger, to_B}}, share).front().contact;
    MoveTip(world, finger, at, next, ChooseSlide(world, finger, next, direction).hand, duration);
    at = next;
  }
  (void)WaitUntilStill(world);
  world.engine().SetSite(finger, site);
  state.sliding = false;
  state.touch_B = to_B.p;
  TransferForces(world, world.HoldingFingers());
}

}  // namespace regrasp::sim
