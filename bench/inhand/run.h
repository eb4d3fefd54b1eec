#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/hand_bodies.h"
#include "bench/inhand/row.h"
#include "bench/inhand/task.h"
#include "planner/plan/plan.h"

namespace regrasp::bench {

/// Settings of a run, which are the same for all hands.
struct ScoreRun {
  std::vector<Chain> chains;
  const std::vector<HandBody>* bodies = nullptr;
  const std::vector<kinematics::HandFile>* hands = nullptr;
  double limit_s = 8;  ///< processor time to plan one task, s
  /// folder of plan files, with a subfolder for each hand; empty: not written
  std::filesystem::path plans;
  HoldingWay way = {};
};

/// @throws InputError  if there is no object with this name.
[[nodiscard]] const HandBody& BodyNamed(const std::vector<HandBody>& bodies,
                                        const std::string& name);

/// Plan and evaluate the tasks of a chain one after the other.
/// Each task starts from the final state of the plan before it. Tasks after one without a plan are
/// not planned.
[[nodiscard]] std::vector<Row> RunChain(const ScoreRun& run, const Chain& chain,
                                        const kinematics::HandFile& hand);

/// Run every chain in every hand, and append its rows to the results when it ends.
/// Each chain runs in its own process, at most `jobs` at a time. Existing results for the same hand
/// and limit are not computed again, so that an interrupted run continues.
/// @param report  callback for progress.
/// @returns the signal that stopped the run; 0 if all ended.
/// @throws EnvironmentError  if results or plans cannot be written.
[[nodiscard]] int RunAll(const ScoreRun& run, const std::filesystem::path& results, int jobs,
                         const std::function<void(std::string_view)>& report);

}  // namespace regrasp::bench
