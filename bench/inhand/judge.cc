#include "bench/inhand/judge.h"

#include <cmath>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/plan/plan.h"

namespace regrasp::bench {
namespace {

constexpr double kMostOff_m = 1e-3;
constexpr double kMostOff_rad = Radians(1);
/// Maximum displacement of the centroid, if a task is a rotation.
constexpr double kMostWandered_m = 0.05;
/// Tolerance for scales and friction angles, which are written as decimals.
constexpr double kRounding = 1e-9;

PoseError Between(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& goal,
                  const Eigen::Vector3d& centre) {
  return {(pose * centre - goal * centre).norm(),
          Eigen::AngleAxisd(pose.linear().transpose() * goal.linear()).angle()};
}

/// Return the rotation about an axis of the object, summed along a plan's paths: whole turns count.
double TurnedAbout(const Eigen::Vector3d& axis, const plan::Plan& plan) {
  Eigen::Matrix3d before = plan.hand->initial.pose.linear();
  double sum = 0;
  for (const plan::Step& step : plan.steps) {
    for (const plan::HandPath* path : plan::PathsOf(step)) {
      for (const plan::HandState& state : *path) {
        const Eigen::AngleAxisd turn(before.transpose() * state.pose.linear());
        sum += turn.angle() * turn.axis().dot(axis);
        before = state.pose.linear();
      }
    }
  }
  return sum;
}

void CheckGoal(const Task& task, const HandBody& body, const plan::Plan& plan,
               const std::string& name) {
  const Eigen::Isometry3d goal = GoalPose(task, body.centre(), plan.hand->initial.pose);
  const PoseError off = Between(EndOf(plan).pose, goal, body.centre());
  const auto refuse = [&](const std::string& what) {
    throw InputError(name + ": not a plan for " + task.name + ": " + what);
  };
  if (off.radians > kMostOff_rad) {
    refuse("the body ends " + FormatShort(Degrees(off.radians), 3) + " degrees from its goal");
  }
  if (off.metres > (task.is_turn() ? kMostWandered_m : kMostOff_m)) {
    refuse("the body ends " + FormatShort(1e3 * off.metres, 3) + " mm from its goal");
  }
  if (!task.is_turn()) return;
  const double turned = TurnedAbout(task.turn.axis, plan);
  if (std::abs(turned - task.turn.angle) > Radians(180)) {
    refuse("the body turns by " + FormatShort(Degrees(turned), 3) + " degrees, not by " +
           FormatShort(Degrees(task.turn.angle), 3));
  }
}

}  // namespace

void CheckIsFor(const Task& task, const HandBody& body, const kinematics::HandFile& hand,
                const plan::Plan& plan, const std::string& name) {
  if (!plan.hand) throw InputError(name + ": /hand: the plan is for no hand");
  if (plan.hand->sha256 != hand.hand.sha256) {
    throw InputError(name + ": /hand/sha256: the plan is for the hand " + plan.hand->name +
                     " with digest " + plan.hand->sha256 + ", but " + hand.hand.name + " has " +
                     hand.hand.sha256);
  }
  if (plan.object_sha256 != body.file.sha256) {
    throw InputError(name + ": /object/sha256: the plan is for " + plan.object_file +
                     " with digest " + plan.object_sha256 + ", but the body " + body.name + " of " +
                     task.name + " has " + body.file.sha256);
  }
  if (std::abs(plan.scale - body.scale) > kRounding * body.scale) {
    throw InputError(name + ": /object/scale: " + FormatDouble(plan.scale) + ", but the body " +
                     body.name + " has " + FormatDouble(body.scale));
  }
  if (plan.friction_angle > std::atan(kFriction) + kRounding) {
    throw InputError(name + ": the plan's friction is " +
                     FormatShort(std::tan(plan.friction_angle)) + ", more than " +
                     FormatShort(kFriction));
  }
  CheckGoal(task, body, plan, name);
}

Verdict Judge(const Task& task, const HandBody& body, const kinematics::HandFile& hand,
              const plan::Plan& plan) {
  if (const auto fault = CheckInHand(hand, body, plan)) return {fault, {}};
  const HandTrial trial = TryInHand(hand, body, plan);
  Verdict verdict{trial.fault, {}};
  if (!trial.end) return verdict;
  const Eigen::Isometry3d goal = GoalPose(task, body.centre(), plan.hand->initial.pose);
  verdict.error = Between(*trial.end, goal, body.centre());
  if (task.is_turn()) {
    verdict.error->metres = Between(*trial.end, EndOf(plan).pose, body.centre()).metres;
  }
  return verdict;
}

std::optional<TrialFault> CheckStart(const TaskStart& start, const plan::Plan& plan) {
  for (const plan::FingerContact& before : start.holding) {
    const plan::FingerContact* now = plan::FindFinger(plan.initial, before.finger);
    if (now != nullptr && now->contact.p == before.contact.p) continue;
    return TrialFault{plan::Reason::kStartDiffers, "finger " + std::to_string(before.finger) +
                                                       " holds another contact than at the end of "
                                                       "the plan before"};
  }
  return std::nullopt;
}

}  // namespace regrasp::bench
