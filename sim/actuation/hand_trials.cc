#include "sim/actuation/hand_trials.h"

#include "planner/base/random.h"

namespace regrasp::sim {
namespace {

Eigen::Vector3d DrawVector(double deviation, RandomStream& random) {
  Eigen::Vector3d drawn;
  for (double& x : drawn) x = deviation * random.Normal();
  return drawn;
}

}  // namespace

TrialSummary RunHandTrials(const kinematics::HandFile& file, const object::Polyhedron& solid,
                           const plan::Plan& plan, const HandReplayOptions& options,
                           const TrialOptions& trials,
                           const std::function<void(int done)>& progress) {
  const double radius = plan.scale * solid.diameter() / 2;
  const double deviation = trials.position_noise * 2 * radius;
  const auto replay = [&](int trial) {
    RandomStream random(trials.seed, RandomUse::kTrialContacts, trial);
    const TrialFactors factors = DrawTrialFactors(trials, trial);
    HandReplayOptions drawn = options;
    drawn.friction_factor = factors.friction;
    drawn.mass_factor = factors.mass;
    drawn.start_shift_m = DrawVector(deviation, random);
    drawn.start_turn_rad = DrawVector(deviation / radius, random);
    for (const kinematics::Finger& finger : file.hand.fingers) {
      kinematics::Posture& offsets = drawn.joint_offsets.emplace_back(finger.drives);
      for (double& offset : offsets) offset = trials.joint_noise.value_or(0) * random.Normal();
    }
    return ReplayHand(file, solid, plan, drawn).steps.back();
  };
  return CountTrials(trials, replay, progress);
}

}  // namespace regrasp::sim
