#include "sim/replay/trials.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/reach.h"
#include "planner/object/surface_walk.h"
#include "sim/replay/finger_paths.h"
#include "sim/replay/replay.h"

namespace regrasp::sim {

namespace {

using Eigen::Vector3d;
using object::SurfaceLeg;

/// Fingers with their planned and their actual contacts.
class NoisyHand {
 public:
  NoisyHand(const object::Object& object, const ContactNoise& noise, RandomStream& random)
      : object_(object), noise_(noise), random_(random) {}

  /// Place a free finger on the surface.
  void Place(plan::FingerContact& held) {
    const grasp::Contact actual = Draw(held.contact);
    held_[held.finger] = {held.contact, actual};
    held.contact = actual;
  }

  /// Move the holding fingers from waypoint to waypoint.
  void Move(plan::Align& align) {
    std::vector<plan::FingerGrasp> noisy;
    for (const plan::FingerGrasp& waypoint : align.waypoints) {
      FingerPaths ways;
      for (const plan::FingerContact& held : waypoint) ways.Add(held, WayTo(held));
      ways.AppendTo(object_, noisy);
    }
    // Keep two waypoints if no finger moves.
    if (noisy.size() == 1) noisy.push_back(noisy.front());
    align.waypoints = std::move(noisy);
  }

 private:
  struct Held {
    grasp::Contact meant;
    grasp::Contact actual;
  };

  [[nodiscard]] std::vector<Vector3d> Directions(const grasp::Contact& contact) const {
    const Vector3d n = contact.n;
    if (object_.dimension() == 2) return {Vector3d(-n.y(), n.x(), 0)};
    const Vector3d across = n.unitOrthogonal();
    return {across, n.cross(across)};
  }

  [[nodiscard]] bool CanTouch(const grasp::Contact& at) const {
    return criteria::ComputeClearance(object_, at, noise_.fingertip) >= noise_.fingertip;
  }

  [[nodiscard]] std::optional<grasp::Contact> DrawOnce(const grasp::Contact& meant) {
    Vector3d off = Vector3d::Zero();
    for (const Vector3d& along : Directions(meant)) {
      off += noise_.deviation * random_.Normal() * along;
    }
    const auto legs = object::WalkStraight(object_, meant.face, meant.p, off);
    if (!legs) return std::nullopt;
    const SurfaceLeg& last = legs->back();
    const grasp::Contact drawn{last.to, object_.inward_normal(last.face), last.face, meant.torsion};
    return CanTouch(drawn) ? std::optional(drawn) : std::nullopt;
  }

  [[nodiscard]] grasp::Contact Draw(const grasp::Contact& meant) {
    if (noise_.deviation == 0) return meant;
    for (int i = 0; i < kMostNoiseDraws; ++i) {
      if (const auto drawn = DrawOnce(meant)) return *drawn;
    }
    return meant;
  }

  /// Return the path of a finger to its place at a waypoint; one leg of length 0 if it stays.
  [[nodiscard]] std::vector<SurfaceLeg> WayTo(const plan::FingerContact& to) {
    const auto at = held_.find(to.finger);
    if (at == held_.end()) {
      plan::FingerContact placed = to;
      Place(placed);
      return {{placed.contact.face, placed.contact.p, placed.contact.p}};
    }
    auto& [meant, actual] = at->second;
    const double same = object::kPointTolerance * object_.diameter();
    const bool stays = (meant.p - to.contact.p).norm() <= same;
    meant = to.contact;
    if (stays) return {{actual.face, actual.p, actual.p}};
    for (int i = 0; i < kMostNoiseDraws; ++i) {
      const grasp::Contact drawn = Draw(meant);
      const auto way = object::HeadFor(object_, actual.face, actual.p, drawn.face, drawn.p);
      if (!way) continue;
      actual = drawn;
      return *way;
    }
    // Without a path along the surface it moves straight, as in the plan.
    const Vector3d from = actual.p;
    actual = meant;
    return {{meant.face, from, meant.p}};
  }

  const object::Object& object_;
  ContactNoise noise_;
  RandomStream& random_;
  std::map<FingerIndex, Held> held_;
};

}  // namespace

plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                           const ContactNoise& noise, RandomStream& random) {
  if (noise.deviation == 0) return plan;
  plan::Plan noisy = plan;
  NoisyHand hand(object, noise, random);
  for (plan::FingerContact& held : noisy.initial) hand.Place(held);
  for (plan::Step& step : noisy.steps) {
    if (auto* change = std::get_if<plan::Switch>(&step)) {
      for (plan::FingerContact& held : change->place) hand.Place(held);
    } else if (auto* align = std::get_if<plan::Align>(&step)) {
      hand.Move(*align);
    }
  }
  return noisy;
}

namespace {

void CheckOptions(const TrialOptions& trials) {
  if (trials.count < 1)
    throw std::invalid_argument("RunTrials: the number of trials must be positive");
  for (const double size : {trials.position_noise, trials.friction_error, trials.mass_error}) {
    if (!(size >= 0 && size <= kMostError)) {
      throw std::invalid_argument("RunTrials: errors must be in [0, 1]");
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
    drawn.resisted_wrench = false;  // only the nominal replay measures it
    drawn.friction_factor = factors.friction;
    drawn.mass_factor = factors.mass;
    const plan::Plan noisy = AddContactNoise(object, plan, noise, contacts);
    return ReplayPlan(object, noisy, drawn).steps.back();
  };
  return CountTrials(trials, replay, progress);
}

}  // namespace regrasp::sim
