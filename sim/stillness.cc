#include "sim/stillness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace regrasp {
namespace {

using Eigen::Vector3d;

/// Where the object and the fingers that hold it are.
struct Posture {
  Eigen::Isometry3d X_SB;
  std::vector<int> fingers;
  std::vector<Vector3d> tips_S;
};

Posture TakePosture(const Stage& stage) {
  Posture posture{stage.X_SB(), stage.HoldingFingers(), {}};
  for (const int f : posture.fingers) posture.tips_S.push_back(stage.engine().tip(f));
  return posture;
}

/// How far the body's points move in a turn, over the angle: metres, at most its radius.
double ArmOf(const Eigen::AngleAxisd& turn_B, const Stage& stage) {
  const ReplaySettings& s = stage.settings();
  const Vector3d& axis = turn_B.axis();
  const double gyration =
      std::sqrt(axis.dot(stage.scene().inertia * axis) / (s.mass_factor * s.mass_kg));
  return std::min(s.diameter_m / 2, kArmOfGyration * gyration);
}

/// The largest way of any of them, metres.
double WayFrom(const Posture& from, const Stage& stage) {
  const Eigen::Isometry3d X_SB = stage.X_SB();
  const Eigen::AngleAxisd turn_B(
      Eigen::Quaterniond(from.X_SB.linear().transpose() * X_SB.linear()));
  double way = (X_SB.translation() - from.X_SB.translation()).norm() +
               ArmOf(turn_B, stage) * std::abs(turn_B.angle());
  for (std::size_t i = 0; i < from.fingers.size(); ++i) {
    way = std::max(way, (stage.engine().tip(from.fingers[i]) - from.tips_S[i]).norm());
  }
  return way;
}

}  // namespace

bool WaitUntilStill(Stage& stage) {
  const double still = kStill * stage.settings().diameter_m;
  const int enough = stage.StepsIn(kStillTime);
  Posture since = TakePosture(stage);
  int quiet = 0;
  for (int i = stage.StepsIn(kLongestWait); i > 0 && quiet < enough; --i) {
    stage.Step();
    if (stage.judge().lost()) return false;
    ++quiet;
    if (WayFrom(since, stage) <= still) continue;
    since = TakePosture(stage);
    quiet = 0;
  }
  return quiet >= enough;
}

void ComeToRest(Stage& stage) {
  if (!WaitUntilStill(stage)) stage.judge().AddUnrest();
  stage.JudgeRest();
}

double FreeMotion(double ramp) {
  return ramp * ramp / 6 + ramp / 2 * kLongestWait + kLongestWait * kLongestWait / 2;
}

}  // namespace regrasp
