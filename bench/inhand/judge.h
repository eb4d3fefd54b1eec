#pragma once

#include <optional>
#include <string>

#include "bench/inhand/plan_task.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"

namespace regrasp::bench {

/// Error of the object's centroid and orientation.
struct PoseError {
  double metres = 0;
  double radians = 0;
};

/// Check that a plan solves a task.
/// It must be a plan for this hand and this object in its size, with at most the friction of the
/// task. It must move the object from its initial pose to the task's goal, within 1 mm and 1°. If
/// the task is a rotation, the centroid may end up to 50 mm away, and whole turns count.
/// @param name  name of the plan in messages.
/// @throws InputError  if the plan is for a different task; the message has the difference and its
///     size.
void CheckIsFor(const Task& task, const HandBody& body, const kinematics::HandFile& hand,
                const plan::Plan& plan, const std::string& name);

struct Verdict {
  std::optional<TrialFault> fault;  ///< fault; nullopt if the plan passes
  /// Pose error of the object at the end of the replay, relative to the task's goal. For a
  /// rotation, the centroid is compared with the plan. Empty if the replay does not reach its end.
  std::optional<PoseError> error;
};

/// Evaluate a plan by the checkers of plans and hands, and by a replay on the hand's own actuators.
/// @param plan  plan for the task (CheckIsFor).
[[nodiscard]] Verdict Judge(const Task& task, const HandBody& body,
                            const kinematics::HandFile& hand, const plan::Plan& plan);

/// Check that a plan begins with the final grasp of the plan before it: with the same fingers at
/// the same contacts.
/// @returns difference, if any. The other fingers are not compared.
[[nodiscard]] std::optional<TrialFault> CheckStart(const TaskStart& start, const plan::Plan& plan);

}  // namespace regrasp::bench
