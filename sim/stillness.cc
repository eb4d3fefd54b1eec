#include "sim/stillness.h"

#include <algorithm>
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

/// The largest way of any of them, metres.
double WayFrom(const Posture& from, const Stage& stage) {
  double way = MeasureMotion(from.X_SB, stage.X_SB(), stage.settings().diameter_m / 2);
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
