#pragma once

#include <optional>
#include <string>

#include "bench/hand_trial.h"
#include "bench/inhand/task.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::bench {

/// Initial state of a task: the pose of the object, and the fingers in contact.
struct TaskStart {
  Eigen::Isometry3d pose;
  plan::FingerGrasp holding;
};

/// Return the final state of a plan, for the task after it. @param plan  plan with a hand.
[[nodiscard]] TaskStart EndOf(const plan::Plan& plan);

/// How plans hold the object; the default is that of the program `plan`.
struct HoldingWay {
  /// Set if grasps may hold the object by its weight.
  std::optional<plan::GravitySupport> gravity_support = {};
  bool rolls = false;  ///< whether fingertips roll
};

struct PlannedTask {
  std::optional<plan::Plan> plan;
  double seconds = 0;   ///< processor time, s
  std::string message;  ///< message if there is no plan
  /// Reason of the failure in simulation, if plans were found but none executes.
  std::optional<plan::Reason> trial = {};
};

/// Plan a task as the program `plan` does with its usual options.
/// These are the robustness margins, only plans
/// that execute in simulation on the hand's own
/// actuators, and grasps with a quality of
/// at least 0.01.
/// @param start    initial state; none: chosen by the planner. A task that moves the centroid
///     begins in a pose with good reach throughout the motion.
/// @param limit_s  processor time limit, s.
[[nodiscard]] PlannedTask PlanTask(const kinematics::HandFile& hand, const HandBody& body,
                                   const Task& task, const std::optional<TaskStart>& start,
                                   double limit_s, const HoldingWay& way = {});

}  // namespace regrasp::bench
