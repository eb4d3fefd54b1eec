#include "sim/motions.h"

#include <algorithm>

#include "sim/grasp_control.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// From 0 to 1 with no speed at either end.
double Smooth(double t) { return t * t * (3 - 2 * t); }

double Mix(double from, double to, double share) { return (1 - share) * from + share * to; }

/// How far a finger stands off: not into what lies opposite, in a hole. The ball of twice the
/// fingertip's radius at the contact is empty (DeriveSettings).
double StandOff(const Stage& stage) {
  return std::min(kStandOff * stage.settings().diameter_m, 2 * stage.settings().fingertip_radius_m);
}

void Touch(Stage& stage, int finger) {
  StageFinger& state = stage.fingers()[finger];
  const Vector3d tip = stage.engine().tip(finger);
  // Same control as before: what pressed through the spring now presses through the feed-forward.
  state.force_S += stage.settings().finger_stiffness_N_m * (state.anchor_S - tip);
  state.anchor_S = tip;
  state.holding = true;
  state.touch_B = stage.ContactPoint_B(finger);
}

void Appear(Stage& stage, const FingerContact& placed_B, double gap) {
  StageFinger& state = stage.fingers()[placed_B.finger];
  state.contact = placed_B.contact;
  state.force_S.setZero();
  state.anchor_S = stage.TipAt_S(placed_B.contact, gap);
  stage.engine().PlaceTip(placed_B.finger, state.anchor_S);
  stage.engine().SetSite(placed_B.finger, FindSite(stage.scene(), placed_B.contact));
}

void Descend(Stage& stage, const FingerGrasp& placed_B, double from, double to, double duration) {
  stage.Run(duration, [&](double share) {
    for (const FingerContact& placed : placed_B) {
      stage.fingers()[placed.finger].anchor_S =
          stage.TipAt_S(placed.contact, Mix(from, to, Smooth(share)));
    }
  });
}

void CreepUntilTouch(Stage& stage, const FingerGrasp& placed_B) {
  const ReplaySettings& s = stage.settings();
  const int most = stage.StepsIn(kMostCreepTime);
  const double way = kCreepSpeed * kMostCreepTime;
  FingerGrasp open = placed_B;
  for (int i = 1; i <= most && !open.empty(); ++i) {
    const double gap = kCreepGap - way * i / most;
    for (const FingerContact& placed : open) {
      stage.fingers()[placed.finger].anchor_S = stage.TipAt_S(placed.contact, gap * s.diameter_m);
    }
    stage.Step();
    std::erase_if(open, [&](const FingerContact& placed) {
      const bool touches =
          stage.engine().contact_force(placed.finger).norm() >= kTouchForce * s.squeeze_N;
      if (touches) Touch(stage, placed.finger);
      return touches;
    });
  }
  for (const FingerContact& placed : open) Touch(stage, placed.finger);
}

}  // namespace

void TakeHold(Stage& stage, const FingerGrasp& grasp_B) {
  for (const FingerContact& held : grasp_B) {
    Appear(stage, held, -kFirstDepth * stage.settings().diameter_m);
    stage.fingers()[held.finger].role = FingerRole::kHolding;
    Touch(stage, held.finger);
  }
  stage.SetGravity(stage.settings().gravity_m_s2);
  const HandForces forces = PlanHandForces(stage, stage.HoldingFingers(), {}, stage.half_angle());
  const HandForces none(forces.size(), Vector3d::Zero());
  stage.Run(kHoldTime, [&](double share) {
    stage.SetGravity(share * stage.settings().gravity_m_s2);
    MixForces(stage, none, forces, share);
  });
}

void PlaceFingers(Stage& stage, const FingerGrasp& placed_B) {
  if (placed_B.empty()) return;
  const double D = stage.settings().diameter_m;
  const double away = StandOff(stage);
  for (const FingerContact& placed : placed_B) {
    Appear(stage, placed, away);
    stage.fingers()[placed.finger].role = FingerRole::kPlaced;
  }
  Descend(stage, placed_B, away, std::min(away, kApproachGap * D), kApproachTime);
  Descend(stage, placed_B, std::min(away, kApproachGap * D), kCreepGap * D, kCloseTime);
  CreepUntilTouch(stage, placed_B);
}

void TransferForces(Stage& stage, const std::vector<int>& fingers) {
  const HandForces from = CurrentForces(stage);
  const HandForces to = PlanHandForces(stage, fingers, {}, stage.half_angle());
  stage.Run(kTransferTime, [&](double share) { MixForces(stage, from, to, share); });
}

void RetractFingers(Stage& stage, const std::vector<int>& fingers) {
  if (fingers.empty()) return;
  std::vector<Vector3d> start, way;
  for (const int f : fingers) {
    StageFinger& finger = stage.fingers()[f];
    finger.holding = false;
    finger.role = FingerRole::kReleased;
    start.push_back(finger.anchor_S);
    way.push_back(-StandOff(stage) * (stage.X_SB().linear() * finger.contact.n));
  }
  stage.Run(kRetractTime, [&](double share) {
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      stage.fingers()[fingers[i]].anchor_S = start[i] + Smooth(share) * way[i];
    }
  });
  for (const int f : fingers) stage.engine().SetSite(f, -1);
}

void SwitchFingers(Stage& stage, const FingerGrasp& placed_B, const std::vector<int>& released) {
  PlaceFingers(stage, placed_B);
  std::vector<int> after = stage.HoldingFingers();
  std::erase_if(after, [&](int f) { return std::ranges::find(released, f) != released.end(); });
  TransferForces(stage, after);
  RetractFingers(stage, released);
}

}  // namespace regrasp
