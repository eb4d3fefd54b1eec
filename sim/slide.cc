#include "sim/slide.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/align.h"
#include "sim/grasp_control.h"
#include "sim/motions.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Normal forces that are tried for a sliding finger, over the squeeze: from the least upwards by
/// this factor.
constexpr double kForceFactor = 1.5;
constexpr double kLargestSlideForce = 0.5;

/// A slide whose others keep this share of the mean normal force inside their cones is good enough
/// that a smaller force of the sliding finger is not given up for more.
constexpr double kGoodMargin = 0.05;

struct SlideForces {
  HandForces hand;
  double margin = 0;
};

/// Forces while `finger` slides towards `direction_B`, pressing with `normal`: the finger's is on
/// its cone's edge, the others balance it and the weight inside narrower cones.
SlideForces PlanSlide(const Stage& stage, int finger, const Contact& at_B,
                      const Vector3d& direction_B, double normal) {
  const double mu = stage.settings().mu;
  const double radius = stage.settings().diameter_m / 2;
  const Vector3d pushed_B = normal * (at_B.n + mu * direction_B);
  std::vector<int> others = stage.HoldingFingers();
  std::erase(others, finger);
  Grasp contacts;
  for (const int f : others) {
    contacts.push_back({stage.ContactPoint_B(f), stage.fingers()[f].contact.n, -1});
  }
  const Eigen::Matrix3d R_SB = stage.X_SB().linear();
  const Wrench load{R_SB.transpose() * stage.weight_S() + pushed_B,
                    at_B.p.cross(pushed_B) / radius};
  const GraspForces planned =
      ComputeGraspForces(contacts, stage.frame_B(), std::atan(kSlideFriction * mu), load,
                         stage.settings().squeeze_N - normal);
  SlideForces result{HandForces(stage.fingers().size(), Vector3d::Zero()), planned.margin};
  for (std::size_t i = 0; i < others.size(); ++i) {
    result.hand[others[i]] = R_SB * planned.forces[i];
  }
  result.hand[finger] = R_SB * pushed_B;
  return result;
}

/// The smallest normal force with a good margin, or else the one with the best.
SlideForces ChooseSlide(const Stage& stage, int finger, const Contact& at_B,
                        const Vector3d& direction_B) {
  std::optional<SlideForces> best;
  for (double share = kSlideForce; share <= kLargestSlideForce; share *= kForceFactor) {
    SlideForces tried =
        PlanSlide(stage, finger, at_B, direction_B, share * stage.settings().squeeze_N);
    if (!best || tried.margin > best->margin) best = std::move(tried);
    if (best->margin >= kGoodMargin) break;
  }
  return *best;
}

void BlendTo(Stage& stage, const HandForces& to) {
  const HandForces from = CurrentForces(stage);
  stage.Run(kTransferSteps, [&](double share) { MixForces(stage, from, to, share); });
}

Vector3d Direction(const Contact& from, const Contact& to) {
  const Vector3d way = to.p - from.p;
  const Vector3d along = way - way.dot(to.n) * to.n;
  return along.norm() > 0 ? Vector3d(along.normalized()) : Vector3d::Zero();
}

/// Moves the tip; at a border it rolls about the contact while both faces stop it.
void MoveTip(Stage& stage, int finger, const Contact& from, const Contact& to) {
  StageFinger& state = stage.fingers()[finger];
  const double way = (to.p - from.p).norm() + stage.settings().fingertip_radius_m *
                                                  std::acos(std::clamp(from.n.dot(to.n), -1., 1.));
  const int steps =
      std::max(kLeastSlideSteps,
               static_cast<int>(std::ceil(way / (kSlideStep * stage.settings().diameter_m))));
  const Vector3d offset = state.anchor_S - stage.TipAt_S(from, 0);
  stage.engine().AddSite(finger, FindSite(stage.scene(), to));
  stage.Run(steps, [&](double share) {
    const Contact at = Interpolate({{finger, from}}, {{finger, to}}, share).front().contact;
    state.contact = at;
    state.anchor_S = stage.TipAt_S(at, 0) + (1 - share) * offset;
  });
  state.contact = to;
  stage.engine().SetSite(finger, FindSite(stage.scene(), to));
}

}  // namespace

void SlideFinger(Stage& stage, int finger, const Contact& from_B, const Contact& to_B) {
  const SlideForces forces = ChooseSlide(stage, finger, from_B, Direction(from_B, to_B));
  BlendTo(stage, forces.hand);
  StageFinger& state = stage.fingers()[finger];
  state.sliding = true;
  MoveTip(stage, finger, from_B, to_B);
  state.sliding = false;
  state.touch_B = to_B.p;
  TransferForces(stage, stage.HoldingFingers());
}

}  // namespace regrasp
