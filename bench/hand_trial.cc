#include "bench/hand_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/required_half_angle.h"
#include "planner/object/body_measures.h"
#include "planner/plan/check.h"
#include "sim/actuation/hand_replay.h"
#include "sim/hand/check_hand.h"

namespace regrasp::bench {
namespace {

TrialFault FaultOf(plan::Reason reason, plan::EntryIndex entry, const std::string& detail) {
  return {reason, "step " + std::to_string(entry) + ": " + detail};
}

/// That the contacts need which press on the object.
double CriticalFriction(const sim::HandWorld& world, const HandBody& body, double scale) {
  grasp::Grasp grasp;
  for (FingerIndex finger{0}; finger < std::ssize(world.hand().fingers); ++finger) {
    const sim::TipTouch touch = world.touch(finger);
    if (touch.force.isZero(0)) continue;
    grasp.push_back({touch.point_O / scale, touch.inward_O, {}});
  }
  const auto required = grasp::ComputeRequiredHalfAngle(grasp, body.solid().wrench_frame());
  return required ? std::tan(required->upper) : std::numeric_limits<double>::infinity();
}

}  // namespace

std::optional<TrialFault> CheckInHand(const kinematics::HandFile& hand, const HandBody& body,
                                      const plan::Plan& plan) {
  plan::CheckOptions options;
  options.hand_faults = sim::CheckHand(hand, body.solid(), plan::LocatePlan(body.solid(), plan));
  const plan::PlanCheck check = plan::CheckPlan(body.solid(), plan, options);
  const auto failed = std::ranges::find_if(
      check.steps, [](const plan::StepCheck& step) { return step.reason != plan::Reason::kNone; });
  if (failed == check.steps.end()) return std::nullopt;
  return FaultOf(failed->reason, failed->index, failed->detail);
}

HandTrial TryInHand(const kinematics::HandFile& hand, const HandBody& body, const plan::Plan& plan,
                    double friction_factor) {
  sim::HandReplayOptions options;
  options.half_angle = std::atan(kFriction);
  options.friction_factor = friction_factor;
  options.mass_kg = object::MeasureBody(body.solid(), body.scale).mass_kg;
  const plan::EntryIndex end(static_cast<int>(plan.steps.size()));
  HandTrial trial;
  sim::HandReplayObserver observer;
  observer.on_rest = [&](const sim::HandWorld& world, plan::EntryIndex entry) {
    if (entry == end) trial.end = world.object_pose();
    trial.critical_friction =
        std::max(trial.critical_friction, CriticalFriction(world, body, plan.scale));
  };
  const sim::ReplayResult replay =
      sim::ReplayHand(hand, body.solid(), plan::LocatePlan(body.solid(), plan), options, observer);
  for (const sim::StepReplay& step : replay.steps) trial.simulated_s += step.hand->simulated_s;
  const sim::StepReplay& last = replay.steps.back();
  if (last.reason != plan::Reason::kNone) {
    trial.fault = FaultOf(last.reason, last.index, last.detail);
  }
  if (trial.end) {
    trial.off_m = last.hand->rest_off_m;
    trial.off_rad = last.hand->rest_off_rad;
  }
  return trial;
}

}  // namespace regrasp::bench
