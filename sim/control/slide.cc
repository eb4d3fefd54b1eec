#include "sim/control/slide.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/grasp/sliding_forces.h"
#include "sim/control/align.h"
#include "sim/control/grasp_control.h"
#include "sim/control/motions.h"
#include "sim/scene/align_path.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// The largest normal force of a sliding finger that is tried, over the squeeze.
constexpr double kLargestSlideForce = 0.5;

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
  const std::vector<FingerIndex> holding = world.HoldingFingers();
  grasp::Grasp contacts;
  std::vector<grasp::SlidingContact> sliding;
  for (const FingerIndex f : holding) {
    if (f == finger) {
      sliding.push_back({static_cast<int>(contacts.size()), direction_B});
      contacts.push_back(at_B);
    } else {
      contacts.push_back(
          {world.ContactPoint_B(f), world.fingers()[f].contact.n, {}, world.settings().torsion_m});
    }
  }
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  const grasp::Wrench load{R_SB.transpose() * world.weight_S(), Vector3d::Zero()};
  const grasp::GraspForces planned = grasp::ComputeSlidingForces(
      contacts, sliding, world.frame_B(), {mu, std::atan(friction_share * mu)}, load,
      world.settings().squeeze_N, normal);
  SlideForces result{HandForces(world.fingers().size(), Vector3d::Zero()), planned.margin};
  for (std::size_t i = 0; i < holding.size(); ++i) {
    result.hand[holding[i]] = R_SB * planned.forces[i];
  }
  return result;
}

/// The smallest normal force with a good margin, or else the one with the best; with the whole
/// friction only where kSlideFriction of it leaves no margin.
SlideForces ChooseSlide(const ReplayWorld& world, FingerIndex finger, const grasp::Contact& at_B,
                        const Vector3d& direction_B) {
  std::optional<SlideForces> best;
  const double squeeze = world.settings().squeeze_N;
  for (const double friction_share : {kSlideFriction, 1.0}) {
    const auto plan = [&](double normal) {
      return PlanSlide(world, finger, at_B, direction_B, normal, friction_share);
    };
    const grasp::SlidingNormal chosen =
        grasp::ChooseSlidingNormal(kSlideForce * squeeze, kLargestSlideForce * squeeze,
                                   [&](double normal) { return plan(normal).margin; });
    if (!best || chosen.margin > best->margin) best = plan(chosen.normal);
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
