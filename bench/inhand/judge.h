#pragma once

#include <optional>
#include <string>

#include "bench/hand_bodies.h"
#include "bench/inhand/task.h"
#include "planner/kinematics/hand_file.h"
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::bench {

/// How far the body's centroid and its orientation are from where they should be.
struct PoseError {
  double metres = 0;
  double radians = 0;
};

/// Checks that a plan is one for a task: for this hand, this body in its size and no more friction,
/// and that it brings the body from where it starts to the task's goal, within 1 mm and 1°. Where a
/// task is a turn, the centroid may end 40 mm away, and whole turns count.
/// @param name  how messages call the plan.
/// @throws InputError  it is for something else; says what and by how much.
void CheckIsFor(const Task& task, const HandBody& body, const kinematics::HandFile& hand,
                const plan::Plan& plan, const std::string& name);

struct Verdict {
  plan::Reason reason = plan::Reason::kNone;  ///< none: it passes
  std::string detail;
  /// Of the body at the end of the replay, from the task's goal; of a turn the centroid from where
  /// the plan has it. None where the replay does not come to its end.
  std::optional<PoseError> error;
};

/// Judges a plan: by the checker of plans, by that of hands, and by a replay on the hand's own
/// actuators at the friction of the scoreboard, with shakes, for a body of the density of water.
/// @param plan  for the task (CheckIsFor).
[[nodiscard]] Verdict Judge(const Task& task, const HandBody& body,
                            const kinematics::HandFile& hand, const plan::Plan& plan);

}  // namespace regrasp::bench
