#include "sim/control/motions.h"

#include <algorithm>

namespace regrasp::sim {

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
