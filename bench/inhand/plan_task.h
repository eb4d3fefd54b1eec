#pragma once

#include <optional>
#include <string>

#include "bench/hand_trial.h"
#include "bench/inhand/task.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::bench {

/// How a hand holds a body where a task begins.
struct TaskStart {
  Eigen::Isometry3d pose;
  plan::FingerGrasp holding;
};

/// Where a plan ends, for the task after it. @param plan  for a hand.
[[nodiscard]] TaskStart EndOf(const plan::Plan& plan);

struct PlannedTask {
  std::optional<plan::Plan> plan;
  double seconds = 0;   ///< of the processor
  std::string message;  ///< where there is none
  /// Where plans were found that the hand carries none out of, why not.
  std::optional<plan::Reason> trial = {};
};

/// Plans a task as the program `plan` does by its usual options: with robustness margins, plans
/// tried on the hand's own motors and none that these do not carry out, and grasps of a quality of
/// 0.01.
/// @param start    where it begins; none: wherever the planner likes. A task that moves the
///                 centroid begins where the hand's reach is good, or is there half-way.
/// @param limit_s  of processor time.
[[nodiscard]] PlannedTask PlanTask(const kinematics::HandFile& hand, const HandBody& body,
                                   const Task& task, const std::optional<TaskStart>& start,
                                   double limit_s);

}  // namespace regrasp::bench
