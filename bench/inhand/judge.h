#pragma once

#include <optional>
#include <string>

#include "bench/inhand/plan_task.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"

namespace regrasp::bench {

/// How far the body's centroid and its orientation are from where they should be.
struct PoseError {
  double metres = 0;
  double radians = 0;
};

/// Checks that a plan is one for a task: for this hand, this body in its size and no more friction,
/// and that it brings the body from where it starts to the task's goal, within 1 mm and 1°. Where a
/// task is a turn, the centroid may end 50 mm away, and whole turns count.
/// @param name  how messages call the plan.
/// @throws InputError  it is for something else; says what and by how much.
void CheckIsFor(const Task& task, const HandBody& body, const kinematics::HandFile& hand,
                const plan::Plan& plan, const std::string& name);

struct Verdict {
  std::optional<TrialFault> fault;  ///< none: it passes
  /// Of the body at the end of the replay, from the task's goal; of a turn the centroid from where
  /// the plan has it. None where the replay does not come to its end.
  std::optional<PoseError> error;
};

/// Judges a plan: by the checkers of plans and hands, and by a trial on the hand's own actuators.
/// @param plan  for the task (CheckIsFor).
[[nodiscard]] Verdict Judge(const Task& task, const HandBody& body,
                            const kinematics::HandFile& hand, const plan::Plan& plan);

/// Whether a plan begins as the one before it ended: with the same fingers at the same contacts.
/// @returns what differs. Where the other fingers stand is not asked.
[[nodiscard]] std::optional<TrialFault> CheckStart(const TaskStart& start, const plan::Plan& plan);

}  // namespace regrasp::bench
