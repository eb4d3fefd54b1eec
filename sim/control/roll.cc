#include "sim/control/roll.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/grasp/angle_between.h"
#include "sim/control/align.h"
#include "sim/control/grasp_control.h"
#include "sim/control/motions.h"
#include "sim/scene/align_path.h"
#include "sim/scene/align_script.h"
#include "sim/world/stillness.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Forces are planned anew after this share of D of travel of the tip that goes farthest, and
/// after this turn of a normal, radians: in between they are mixed, and have to fit the cones.
constexpr double kRollSegment = 0.01;
constexpr double kTurnSegment = Radians(2);
/// The engine misses a touch at an edge now and then, so that turns are short.
constexpr double kLeastRollTime = 0.08;  ///< natural times

Vector3d Tip(const grasp::Contact& contact, double radius) {
  return contact.p - radius * contact.n;
}

/// What the fingers have to do at most.
struct Extent {
  double travel = 0;  ///< of a contact, metres
  double turn = 0;    ///< of a normal, radians
};

Extent FindExtent(const plan::FingerGrasp& from, const plan::FingerGrasp& to) {
  Extent most;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const grasp::Contact& a = from[i].contact;
    const grasp::Contact& b = to[i].contact;
    most.travel = std::max(most.travel, (b.p - a.p).norm());
    most.turn = std::max(most.turn, grasp::AngleBetween(a.n, b.n));
  }
  return most;
}

/// Forces that hold the object in a grasp: inside narrower cones where there are such.
HandForces PlanForces(const ReplayWorld& world, const plan::FingerGrasp& grasp_B) {
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  const grasp::Wrench load{R_SB.transpose() * world.weight_S(), Vector3d::Zero()};
  HandForces hand(world.fingers().size(), Vector3d::Zero());
  for (const double friction_share : {kSlideFriction, 1.0}) {
    const grasp::GraspForces planned = grasp::ComputeGraspForces(
        plan::ContactsOf(grasp_B), world.frame_B(), std::atan(friction_share * world.settings().mu),
        load, world.settings().squeeze_N);
    for (std::size_t i = 0; i < grasp_B.size(); ++i) {
      hand[grasp_B[i].finger] = R_SB * planned.forces[i];
    }
    if (planned.balanced && planned.margin > 0) break;
  }
  return hand;
}

/// Takes a tip along with its contact; whatever it is off the plan stays.
void MoveAlong(ReplayWorld& world, FingerIndex finger, const grasp::Contact& contact_B) {
  WorldFinger& state = world.fingers()[finger];
  const double radius = world.settings().fingertip_radius_m;
  const Vector3d offset_S =
      world.X_SB().linear() * (Tip(contact_B, radius) - Tip(state.contact, radius));
  world.engine().ShiftTip(finger, offset_S);
  state.anchor_S += offset_S;
  state.touch_B += contact_B.p - state.contact.p;
  state.contact = contact_B;
}

}  // namespace

void RollFingers(ReplayWorld& world, const plan::FingerGrasp& from_B,
                 const plan::FingerGrasp& to_B) {
  const Extent extent = FindExtent(from_B, to_B);
  const double travel = extent.travel / world.settings().diameter_m;
  const int segments =
      static_cast<int>(std::ceil(std::max(travel / kRollSegment, extent.turn / kTurnSegment)));
  if (segments == 0) return;
  const double duration = std::max(kLeastRollTime, travel / (segments * kSlideSpeed));
  std::vector<SiteIndex> sites;
  for (std::size_t i = 0; i < to_B.size(); ++i) {
    sites.push_back(FindSite(world.scene(), from_B[i].contact, to_B[i].contact));
    world.engine().AddSite(to_B[i].finger, sites.back());
  }
  BlendForces(world, PlanForces(world, from_B));
  plan::FingerGrasp at = from_B;
  for (int i = 1; i <= segments; ++i) {
    const plan::FingerGrasp next = Interpolate(from_B, to_B, static_cast<double>(i) / segments);
    const HandForces before = CurrentForces(world);
    const HandForces after = PlanForces(world, next);
    world.Run(duration, [&](double share) {
      for (const plan::FingerContact& held : Interpolate(at, next, share)) {
        MoveAlong(world, held.finger, held.contact);
      }
      MixForces(world, before, after, share);
    });
    at = next;
  }
  (void)WaitUntilStill(world);
  for (std::size_t i = 0; i < to_B.size(); ++i) {
    world.engine().SetSite(to_B[i].finger, sites[i]);
  }
  TransferForces(world, world.HoldingFingers());
}

}  // namespace regrasp::sim
