#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/hand_bodies.h"
#include "bench/inhand/row.h"
#include "bench/inhand/task.h"

namespace regrasp::bench {

/// What is asked of all hands.
struct ScoreRun {
  std::vector<Chain> chains;
  const std::vector<HandBody>* bodies = nullptr;
  const std::vector<kinematics::HandFile>* hands = nullptr;
  double limit_s = 8;           ///< of the processor, to plan one task
  std::filesystem::path plans;  ///< where plan files go, in a folder for each hand; empty: nowhere
};

/// @throws InputError  there is none of this name.
[[nodiscard]] const HandBody& BodyNamed(const std::vector<HandBody>& bodies,
                                        const std::string& name);

/// Plans and judges the tasks of a chain one after the other, each from where the plan before it
/// ends. Those after one that has no plan are not asked.
[[nodiscard]] std::vector<Row> RunChain(const ScoreRun& run, const Chain& chain,
                                        const kinematics::HandFile& hand);

/// Runs every chain in every hand, each in a process of its own, at most `jobs` at a time, and
/// appends its rows to the results as it ends. What is there already, for the same hand and limit,
/// is not run again: a run that was stopped goes on where it was.
/// @param report  told how far it is.
/// @returns the signal that stopped it; 0 where all ended.
/// @throws EnvironmentError  results or plans cannot be written.
[[nodiscard]] int RunAll(const ScoreRun& run, const std::filesystem::path& results, int jobs,
                         const std::function<void(std::string_view)>& report);

}  // namespace regrasp::bench
