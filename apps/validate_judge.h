#pragma once

#include <vector>

#include "apps/validate_options.h"
#include "apps/validate_task.h"
#include "planner/base/deadline.h"
#include "planner/grasp/contact.h"
#include "planner/plan/check.h"
#include "planner/plan/snapshot.h"
#include "report/report.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/hand_scene_export.h"
#include "sim/actuation/hand_trajectory.h"

namespace regrasp::apps {

/// What is kept of the replay while it runs; states as far as someone asked for them.
struct Samples {
  Stopwatch run;    ///< since the program began
  Stopwatch entry;  ///< since the last entry was done
  std::vector<double> entry_seconds;
  std::vector<plan::Snapshot> trajectory;
  sim::HandTrajectory by_hand;       ///< the same of a replay by a hand
  std::vector<sim::SceneKey> rests;  ///< the same
  std::vector<plan::Snapshot> animation;
};

/// What the analytic check is told besides the plan; it points to the grasps of the files.
struct CheckTask {
  CheckTask(const ValidateOptions& options, const ValidateTask& task);
  CheckTask(const CheckTask&) = delete;
  CheckTask& operator=(const CheckTask&) = delete;

  /// Of a plan for a hand.
  /// @throws InputError  it is none.
  void CheckHand(const ValidateOptions& options, const ValidateTask& task);

  grasp::Grasp start;
  grasp::Grasp goal;
  plan::CheckOptions check;
};

/// What is asked of the replay by a hand, all but the friction.
[[nodiscard]] sim::HandReplayOptions HandOptions(const ValidateOptions& options,
                                                 const ValidateTask& task);

/// Checks and replays the plan or the grasp; with it come trials and proofs where they are asked.
/// Files' names and digests are left to the caller.
/// @throws InputError  plan, object and options do not go together.
[[nodiscard]] report::Report JudgeTask(const ValidateOptions& options, const ValidateTask& task,
                                       Samples& samples);

}  // namespace regrasp::apps
