#include "sim/control/slide.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/base/number.h"
#include "planner/grasp/grasp_forces.h"
#include "planner/grasp/required_friction_angle.h"
#include "sim/scene/align_script.h"
#include "sim/world/motion_monitor.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Travel over D of the fastest fingertip, and turn of a normal in radians, after which forces are
/// planned again. In between they are interpolated and must stay inside the cones.
constexpr double kRollSegment = 0.01;
constexpr double kTurnSegment = Radians(2);
/// Least duration of a segment. Short turns are preferred, because the engine occasionally misses a
/// contact at an edge.
constexpr double kLeastRollTime = 0.08;  ///< characteristic times

Vector3d Tip(const grasp::Contact& contact, double radius) {
  return contact.p - radius * contact.n;
}

/// Largest motions of the fingers.
struct Extent {
  double travel = 0;  ///< travel of a contact, metres
  double turn = 0;    ///< turn of a normal, radians
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

/// Plan forces that hold the object in a grasp, inside narrower cones if possible.
HandForces PlanForces(const ReplayWorld& world, const plan::FingerGrasp& grasp_B) {
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  const grasp::Wrench load{R_SB.transpose() * world.weight_S(), Vector3d::Zero()};
  HandForces hand(world.fingers().size(), Vector3d::Zero());
  for (const double friction_share : {kSlideFriction, 1.0}) {
    const grasp::GraspForces planned = grasp::ComputeGraspForces(
        plan::ContactsOf(grasp_B), world.frame_B(), std::atan(friction_share * world.settings().mu),
        load, world.settings().grasp_force_N);
    for (std::size_t i = 0; i < grasp_B.size(); ++i) {
      hand[grasp_B[i].finger] = R_SB * planned.forces[i];
    }
    if (planned.balanced && planned.margin > 0) break;
  }
  return hand;
}

/// Move a fingertip together with its contact; its deviation from the plan does not change.
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

namespace {

/// Distance over D within which contacts are equal, and the finger does not move.
constexpr double kSamePoint = 1e-9;

bool Stays(const ReplayWorld& world, const grasp::Contact& from, const grasp::Contact& to) {
  return from.face == to.face && (from.p - to.p).norm() <= kSamePoint * world.settings().diameter_m;
}

std::vector<FingerIndex> FingersOf(const plan::FingerGrasp& grasp) {
  std::vector<FingerIndex> fingers;
  for (const plan::FingerContact& held : grasp) fingers.push_back(held.finger);
  return fingers;
}

/// The verdict is final. Continuing with a lost object would take long and add no information.
bool HasFailed(ReplayWorld& world) { return world.monitor().reason() != plan::Reason::kNone; }

void HandOver(ReplayWorld& world, const FingerHandover& move) {
  SwitchFingers(world, move.support_fingers, FingersOf(move.targets));
  SwitchFingers(world, move.targets, FingersOf(move.support_fingers));
}

/// Slide the fingers one after the other; the finger that the others balance best is first.
void Slide(ReplayWorld& world, const plan::FingerGrasp& from, const plan::FingerGrasp& to) {
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (!Stays(world, from[i].contact, to[i].contact)) waiting.push_back(i);
  }
  while (!waiting.empty()) {
    const auto next = std::ranges::max_element(waiting, {}, [&](std::size_t i) {
      return SlideMargin(world, from[i].finger, from[i].contact, to[i].contact);
    });
    SlideFinger(world, from[*next].finger, from[*next].contact, to[*next].contact);
    waiting.erase(next);
  }
}

}  // namespace

AlignMode PerformAlign(ReplayWorld& world, const AlignScript& script_B) {
  bool handed_over = false;
  bool slid = false;
  for (const AlignMove& move : script_B.moves) {
    if (HasFailed(world)) break;
    if (const auto* fingers = std::get_if<FingerHandover>(&move)) {
      handed_over = true;
      HandOver(world, *fingers);
    } else if (const auto* roll = std::get_if<FingersRoll>(&move)) {
      slid = true;
      RollFingers(world, roll->from, roll->to);
    } else {
      slid = true;
      const auto& grasps = std::get<FingersSlide>(move).grasps;
      for (std::size_t i = 1; i < grasps.size() && !HasFailed(world); ++i) {
        Slide(world, grasps[i - 1], grasps[i]);
      }
    }
  }
  if (!slid) return AlignMode::kImitated;
  return handed_over ? AlignMode::kMixed : AlignMode::kSlid;
}

void TellMoved(ReplayWorld& world, const std::vector<plan::FingerGrasp>& waypoints_B) {
  for (WorldFinger& finger : world.fingers()) {
    finger.role = finger.holding ? plan::FingerRole::kHolding : plan::FingerRole::kFree;
  }
  for (const plan::FingerContact& start : waypoints_B.front()) {
    const plan::FingerContact* end = plan::FindFinger(waypoints_B.back(), start.finger);
    if (end == nullptr || Stays(world, start.contact, end->contact)) continue;
    WorldFinger& finger = world.fingers()[start.finger];
    finger.role = plan::FingerRole::kMoved;
    finger.path_B.clear();
    for (const plan::FingerGrasp& grasp_B : waypoints_B) {
      const plan::FingerContact* at = plan::FindFinger(grasp_B, start.finger);
      if (at != nullptr) finger.path_B.push_back(at->contact.p);
    }
  }
}

namespace {

/// Largest normal force of a sliding finger over the grasp force.
constexpr double kLargestSlideForce = 0.5;

/// Travel over D after which forces are planned again.
constexpr double kSegment = 0.01;
constexpr double kLeastSegmentTime = 0.4;  ///< characteristic times

struct SlideForces {
  HandForces hand;
  double margin = 0;
};

/// Plan forces while `finger` slides towards `direction_B` with the normal force `normal`.
/// Its force is on its cone's edge; the others balance it and the weight inside narrower cones.
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
      world.settings().grasp_force_N, normal);
  SlideForces result{HandForces(world.fingers().size(), Vector3d::Zero()), planned.margin};
  for (std::size_t i = 0; i < holding.size(); ++i) {
    result.hand[holding[i]] = R_SB * planned.forces[i];
  }
  return result;
}

/// Choose the smallest normal force with a good margin, otherwise the one with the best margin.
/// The full friction is used only if kSlideFriction of it leaves no margin.
SlideForces ChooseSlide(const ReplayWorld& world, FingerIndex finger, const grasp::Contact& at_B,
                        const Vector3d& direction_B) {
  std::optional<SlideForces> best;
  const double grasp_force = world.settings().grasp_force_N;
  for (const double friction_share : {kSlideFriction, 1.0}) {
    const auto plan = [&](double normal) {
      return PlanSlide(world, finger, at_B, direction_B, normal, friction_share);
    };
    const grasp::SlidingNormal chosen =
        grasp::ChooseSlidingNormal(kSlideForce * grasp_force, kLargestSlideForce * grasp_force,
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

/// Move along one straight segment of the path.
/// Fingertip and forces change together at constant rates.
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

using Eigen::Vector3d;

HandForces PlanHandForces(const ReplayWorld& world, const std::vector<FingerIndex>& fingers,
                          const grasp::Wrench& load_S, double friction_angle) {
  HandForces forces(world.fingers().size(), Vector3d::Zero());
  if (fingers.empty()) return forces;
  const Eigen::Matrix3d R_SB = world.X_SB().linear();
  grasp::Grasp contacts;
  for (const FingerIndex f : fingers) {
    const grasp::Contact& planned = world.fingers()[f].contact;
    contacts.push_back(
        {world.ContactPoint_B(f), planned.n, planned.face, world.settings().torsion_m});
  }
  const grasp::Wrench load_B{R_SB.transpose() * (world.weight_S() + load_S.force),
                             R_SB.transpose() * load_S.torque_over_radius};
  const grasp::GraspForces planned = grasp::ComputeGraspForces(
      contacts, world.frame_B(), friction_angle, load_B, world.settings().grasp_force_N);
  for (std::size_t i = 0; i < fingers.size(); ++i) forces[fingers[i]] = R_SB * planned.forces[i];
  return forces;
}

HandForces CurrentForces(const ReplayWorld& world) {
  HandForces forces;
  for (const WorldFinger& finger : world.fingers()) forces.push_back(finger.force_S);
  return forces;
}

void MixForces(ReplayWorld& world, const HandForces& from, const HandForces& to, double share) {
  for (std::size_t f = 0; f < from.size(); ++f) {
    world.fingers()[f].force_S = (1 - share) * from[f] + share * to[f];
  }
}

namespace {

/// Return a smooth interpolation from 0 to 1 with zero speed at both ends.
double Smooth(double t) { return t * t * (3 - 2 * t); }

double Mix(double from, double to, double share) { return (1 - share) * from + share * to; }

/// Return the distance of a free finger from its contact.
/// In a hole, the finger must not penetrate the opposite side. The sphere of twice the fingertip's
/// radius at the contact is empty (DeriveSettings).
double StandOff(const ReplayWorld& world) {
  return std::min(kStandOff * world.settings().diameter_m, 2 * world.settings().fingertip_radius_m);
}

void Touch(ReplayWorld& world, FingerIndex finger) {
  WorldFinger& state = world.fingers()[finger];
  const Vector3d tip = world.engine().tip(finger);
  // The control does not change: the spring force becomes the feed-forward force.
  state.force_S += world.settings().finger_stiffness_N_m * (state.anchor_S - tip);
  state.anchor_S = tip;
  state.holding = true;
  state.touch_B = world.ContactPoint_B(finger);
}

void Appear(ReplayWorld& world, const plan::FingerContact& placed_B, double gap) {
  WorldFinger& state = world.fingers()[placed_B.finger];
  state.contact = placed_B.contact;
  state.force_S.setZero();
  state.anchor_S = world.TipAt_S(placed_B.contact, gap);
  world.engine().PlaceTip(placed_B.finger, state.anchor_S);
  world.engine().SetSite(placed_B.finger, FindSite(world.scene(), placed_B.contact));
}

void Descend(ReplayWorld& world, const plan::FingerGrasp& placed_B, double from, double to,
             double duration) {
  world.Run(duration, [&](double share) {
    for (const plan::FingerContact& placed : placed_B) {
      world.fingers()[placed.finger].anchor_S =
          world.TipAt_S(placed.contact, Mix(from, to, Smooth(share)));
    }
  });
}

void CreepUntilTouch(ReplayWorld& world, const plan::FingerGrasp& placed_B) {
  const ReplaySettings& s = world.settings();
  const int most = world.StepsIn(kMostCreepTime);
  const double travel = kCreepSpeed * kMostCreepTime;
  plan::FingerGrasp open = placed_B;
  for (int i = 1; i <= most && !open.empty(); ++i) {
    const double gap = kCreepGap - travel * i / most;
    for (const plan::FingerContact& placed : open) {
      world.fingers()[placed.finger].anchor_S = world.TipAt_S(placed.contact, gap * s.diameter_m);
    }
    world.Step();
    std::erase_if(open, [&](const plan::FingerContact& placed) {
      const bool touches =
          world.engine().tip_force(placed.finger).force.norm() >= kTouchForce * s.grasp_force_N;
      if (touches) Touch(world, placed.finger);
      return touches;
    });
  }
  for (const plan::FingerContact& placed : open) Touch(world, placed.finger);
}

}  // namespace

void TakeHold(ReplayWorld& world, const plan::FingerGrasp& grasp_B) {
  for (const plan::FingerContact& held : grasp_B) {
    Appear(world, held, -kFirstDepth * world.settings().diameter_m);
    world.fingers()[held.finger].role = plan::FingerRole::kHolding;
    Touch(world, held.finger);
  }
  world.SetGravity(world.settings().gravity_m_s2);
  const HandForces forces =
      PlanHandForces(world, world.HoldingFingers(), {}, world.friction_angle());
  const HandForces none(forces.size(), Vector3d::Zero());
  world.Run(kHoldTime, [&](double share) {
    world.SetGravity(share * world.settings().gravity_m_s2);
    MixForces(world, none, forces, share);
  });
}

void PlaceFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B) {
  if (placed_B.empty()) return;
  const double D = world.settings().diameter_m;
  const double away = StandOff(world);
  for (const plan::FingerContact& placed : placed_B) {
    Appear(world, placed, away);
    world.fingers()[placed.finger].role = plan::FingerRole::kPlaced;
  }
  Descend(world, placed_B, away, std::min(away, kApproachGap * D), kApproachTime);
  Descend(world, placed_B, std::min(away, kApproachGap * D), kCreepGap * D, kCloseTime);
  CreepUntilTouch(world, placed_B);
}

void TransferForces(ReplayWorld& world, const std::vector<FingerIndex>& fingers) {
  BlendForces(world, PlanHandForces(world, fingers, {}, world.friction_angle()));
}

void BlendForces(ReplayWorld& world, const HandForces& to) {
  const HandForces from = CurrentForces(world);
  world.Run(kTransferTime, [&](double share) { MixForces(world, from, to, share); });
}

void RetractFingers(ReplayWorld& world, const std::vector<FingerIndex>& fingers) {
  if (fingers.empty()) return;
  std::vector<Vector3d> start, offset;
  for (const FingerIndex f : fingers) {
    WorldFinger& finger = world.fingers()[f];
    finger.holding = false;
    finger.role = plan::FingerRole::kReleased;
    start.push_back(finger.anchor_S);
    offset.push_back(-StandOff(world) * (world.X_SB().linear() * finger.contact.n));
  }
  world.Run(kRetractTime, [&](double share) {
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      world.fingers()[fingers[i]].anchor_S = start[i] + Smooth(share) * offset[i];
    }
  });
  for (const FingerIndex f : fingers) world.engine().SetSite(f, SiteIndex());
}

void SwitchFingers(ReplayWorld& world, const plan::FingerGrasp& placed_B,
                   const std::vector<FingerIndex>& released) {
  PlaceFingers(world, placed_B);
  std::vector<FingerIndex> after = world.HoldingFingers();
  std::erase_if(after,
                [&](FingerIndex f) { return std::ranges::find(released, f) != released.end(); });
  TransferForces(world, after);
  RetractFingers(world, released);
}

}  // namespace regrasp::sim
