#include "sim/world/stillness.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// Poses of the object and of the fingers in contact.
struct JointConfiguration {
  Eigen::Isometry3d X_SB;
  std::vector<FingerIndex> fingers;
  std::vector<Vector3d> tips_S;
};

JointConfiguration TakeConfiguration(const ReplayWorld& world) {
  JointConfiguration configuration{world.X_SB(), world.HoldingFingers(), {}};
  for (const FingerIndex f : configuration.fingers)
    configuration.tips_S.push_back(world.engine().tip(f));
  return configuration;
}

/// Return the motion of the object's points per angle of a rotation: metres, at most its radius.
double ArmOf(const Eigen::AngleAxisd& turn_B, const ReplayWorld& world) {
  const ReplaySettings& s = world.settings();
  const Vector3d& axis = turn_B.axis();
  const double gyration =
      std::sqrt(axis.dot(world.scene().inertia * axis) / (s.mass_factor * s.mass_kg));
  return std::min(s.diameter_m / 2, kArmOfGyration * gyration);
}

/// Return whether any of them has moved by more than a limit, metres.
bool HasTravelled(const JointConfiguration& from, double limit, const ReplayWorld& world) {
  const Eigen::Isometry3d X_SB = world.X_SB();
  for (std::size_t i = 0; i < from.fingers.size(); ++i) {
    if ((world.engine().tip(from.fingers[i]) - from.tips_S[i]).norm() > limit) return true;
  }
  // The longest arm first, because it requires no axis.
  if (MeasureMotion(from.X_SB, X_SB, world.settings().diameter_m / 2) <= limit) return false;
  const Eigen::AngleAxisd turn_B(
      Eigen::Quaterniond(from.X_SB.linear().transpose() * X_SB.linear()));
  return (X_SB.translation() - from.X_SB.translation()).norm() +
             ArmOf(turn_B, world) * std::abs(turn_B.angle()) >
         limit;
}

}  // namespace

bool WaitUntilStill(ReplayWorld& world) {
  const double still = kStill * world.settings().diameter_m;
  const int enough = world.StepsIn(kStillTime);
  JointConfiguration since = TakeConfiguration(world);
  int quiet = 0;
  for (int i = world.StepsIn(kLongestWait); i > 0 && quiet < enough; --i) {
    world.Step();
    if (world.monitor().lost()) return false;
    ++quiet;
    if (!HasTravelled(since, still, world)) continue;
    since = TakeConfiguration(world);
    quiet = 0;
  }
  return quiet >= enough;
}

void ComeToRest(ReplayWorld& world) {
  if (!WaitUntilStill(world)) world.monitor().AddUnrest();
  world.MonitorRest();
}

double FreeMotion(double ramp) {
  return ramp * ramp / 6 + ramp / 2 * kLongestWait + kLongestWait * kLongestWait / 2;
}

}  // namespace regrasp::sim
