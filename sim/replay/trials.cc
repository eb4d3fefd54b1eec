#include "sim/replay/trials.h"

#include <cmath>
#include <stdexcept>

#include "planner/base/binomial.h"
#include "planner/base/random.h"
#include "sim/replay/contact_noise.h"
#include "sim/replay/replay.h"

namespace regrasp::sim {

namespace {

void CheckOptions(const TrialOptions& trials) {
  if (trials.count < 1) throw std::invalid_argument("RunTrials: no trials");
  for (const double size : {trials.position_noise, trials.friction_error, trials.mass_error}) {
    if (!(size >= 0 && size <= kMostError)) {
      throw std::invalid_argument("RunTrials: an error is not in [0, 1]");
    }
  }
}

double DrawFactor(double error, RandomStream& random) {
  double factor = 1 + error * random.Normal();
  while (factor < kLeastFactor) factor = 1 + error * random.Normal();
  return factor;
}

}  // namespace

double TrialSummary::share() const { return static_cast<double>(passed) / options.count; }

// Both sides are the doubles nearest to a share: 93 of 100 is enough for 0.93.
bool TrialSummary::enough() const { return share() >= options.min_pass_rate; }

ShareInterval TrialSummary::interval() const {
  return ComputeShareInterval(passed, options.count, kTrialConfidence);
}

TrialFactors DrawTrialFactors(const TrialOptions& trials, int trial) {
  RandomStream world(trials.seed, RandomUse::kTrialWorld, trial);
  TrialFactors factors;
  factors.friction = DrawFactor(trials.friction_error, world);
  factors.mass = DrawFactor(trials.mass_error, world);
  return factors;
}

TrialSummary CountTrials(const TrialOptions& trials,
                         const std::function<StepReplay(int trial)>& replay,
                         const std::function<void(int done)>& progress) {
  CheckOptions(trials);
  TrialSummary summary;
  summary.options = trials;
  for (int trial = 0; trial < trials.count; ++trial) {
    const StepReplay last = replay(trial);
    if (last.reason == plan::Reason::kNone) {
      ++summary.passed;
    } else {
      ++summary.reasons[last.reason];
      ++summary.steps[last.index];
    }
    if (progress) progress(trial + 1);
  }
  return summary;
}

TrialSummary RunTrials(const object::Object& object, const plan::Plan& plan,
                       const ReplayOptions& options, const TrialOptions& trials, double fingertip,
                       const std::function<void(int done)>& progress) {
  const ContactNoise noise{trials.position_noise * object.diameter(), fingertip / plan.scale};
  const auto replay = [&](int trial) {
    RandomStream contacts(trials.seed, RandomUse::kTrialContacts, trial);
    const TrialFactors factors = DrawTrialFactors(trials, trial);
    ReplayOptions drawn = options;
    drawn.stress = false;  // of the nominal replay alone
    drawn.friction_factor = factors.friction;
    drawn.mass_factor = factors.mass;
    const plan::Plan noisy = AddContactNoise(object, plan, noise, contacts);
    return ReplayPlan(object, noisy, drawn).steps.back();
  };
  return CountTrials(trials, replay, progress);
}

}  // namespace regrasp::sim
