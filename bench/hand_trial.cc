#include "bench/hand_trial.h"

#include <algorithm>
#include <cmath>

#include "bench/least_friction.h"
#include "planner/object/body_measures.h"
#include "planner/plan/check.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_world.h"
#include "sim/hand/check_hand.h"
#include "sim/measure/disturbance.h"
#include "sim/scene/scaling.h"

namespace regrasp::bench {
namespace {

TrialFault FaultOf(plan::Reason reason, plan::EntryIndex entry, const std::string& detail) {
  return {reason, "step " + std::to_string(entry) + ": " + detail};
}

/// Return the contacts of the fingertips that exert a force on the object.
grasp::Grasp ContactsNow(const sim::HandWorld& world, double scale) {
  grasp::Grasp contacts;
  for (FingerIndex finger{0}; finger < std::ssize(world.hand().fingers); ++finger) {
    const sim::TipTouch touch = world.touch(finger);
    if (!touch.force.isZero(0)) contacts.push_back({touch.point_O / scale, touch.inward_O, {}});
  }
  return contacts;
}

/// Upper limit of the fingers' total normal force, in commanded grasp forces; never reached.
constexpr double kHardest = 4;

}  // namespace

std::optional<TrialFault> CheckInHand(const kinematics::HandFile& hand, const HandBody& body,
                                      const plan::Plan& plan) {
  plan::CheckOptions options;
  options.hand_faults = sim::CheckHand(hand, body.solid(), plan::ProjectPlan(body.solid(), plan));
  const plan::PlanCheck check = plan::CheckPlan(body.solid(), plan, options);
  const auto failed = std::ranges::find_if(
      check.steps, [](const plan::StepCheck& step) { return step.reason != plan::Reason::kNone; });
  if (failed == check.steps.end()) return std::nullopt;
  return FaultOf(failed->reason, failed->index, failed->detail);
}

HandTrial TryInHand(const kinematics::HandFile& hand, const HandBody& body, const plan::Plan& plan,
                    double friction_factor) {
  sim::HandReplayOptions options;
  options.friction_factor = friction_factor;
  plan::Plan projected = plan::ProjectPlan(body.solid(), plan);
  projected.friction_angle = std::atan(kFriction);
  const plan::EntryIndex end(static_cast<int>(plan.steps.size()));
  HandTrial trial;
  sim::ReplayObserver observer;
  observer.on_rest = [&](const sim::HandWorld& world, plan::EntryIndex entry) {
    if (entry == end) trial.end = world.object_pose();
    trial.rests.push_back({ContactsNow(world, plan.scale), world.object_pose().linear()});
  };
  const sim::ReplayResult replay =
      sim::ReplayHand(hand, body.solid(), projected, options, observer);
  for (const sim::StepReplay& step : replay.steps) trial.simulated_s += step.hand->simulated_s;
  trial.grasp_force_N = replay.settings.grasp_force_N;
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

double RequiredFriction(const HandTrial& trial, const kinematics::HandModel& hand,
                        const HandBody& body) {
  const object::WrenchFrame frame = body.solid().wrench_frame();
  const double weight = object::MeasureBody(body.solid(), body.scale).mass_kg * sim::kGravity;
  const double size = sim::HandReplayOptions().disturbance_ratio * trial.grasp_force_N;
  // The torque of a disturbance is its force times half the diameter. Loads have their torque over
  // the frame's radius.
  const double arm = body.solid().diameter() / 2 / frame.radius;
  double critical = 0;
  for (const HandTrial::Rest& rest : trial.rests) {
    const Eigen::Matrix3d to_object = rest.turn.transpose();
    std::vector<grasp::Wrench> loads;
    for (const sim::Disturbance& disturbance : sim::DisturbanceDirections(3)) {
      const grasp::Wrench wrench = sim::DisturbanceWrench(disturbance, size);
      loads.push_back({to_object * (wrench.force - weight * hand.up),
                       arm * (to_object * wrench.torque_over_radius)});
    }
    critical = std::max(critical,
                        LeastFriction(rest.contacts, frame, loads, kHardest * trial.grasp_force_N));
  }
  return critical;
}

}  // namespace regrasp::bench
