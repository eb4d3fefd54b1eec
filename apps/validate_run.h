#pragma once

#include <string>
#include <vector>

#include "apps/validate_options.h"
#include "sim/actuation/hand_scene_export.h"

namespace regrasp::apps {

// The modes of `validate`. Each returns the exit code.

struct ValidationRun {
  int exit_code = 0;
  std::vector<double> entry_seconds;  ///< duration of each step that was replayed
};

/// Validate one plan (`plan_path`) or grasp with the options: read, check, replay, draw, write the
/// files, and print the table.
///
/// The report is written last. If it exists, the other files are complete.
/// @throws InputError        a file is broken, or does not fit the options.
/// @throws EnvironmentError  there is no rendering context, or a folder cannot be written.
[[nodiscard]] ValidationRun RunValidation(const ValidateOptions& options);

/// Validate each of many plans in a process of its own, into a folder of its own, and write and
/// print a summary of all. An error with one plan does not affect others.
///
/// A batch that a signal stops writes no summary.
/// @returns largest exit code of all plans, or 3 if the process of a plan crashed or was stopped.
///          128 and the number of a signal that stopped the batch and left this process alive.
/// @throws InputError        two plans have one name, or a folder has no plans.
/// @throws EnvironmentError  no process can be started, or a folder cannot be written.
[[nodiscard]] int RunBatch(const ValidateOptions& options);

/// Name of the JSON Lines file of reports in the folder of results.
inline constexpr char kReportsName[] = "reports.jsonl";

/// Validate every plan of a JSON Lines file in processes that share loaded objects, and write
/// reports.jsonl with a line for each. A plan that gets frames also has a folder, named by its
/// number, with plan.json and the results of a single validation.
/// @returns exit code of RunLinesFile.
/// @throws InputError        as RunLinesFile, or an output is an input.
/// @throws EnvironmentError  the folder cannot be written.
[[nodiscard]] int RunValidateLines(const ValidateOptions& options);

/// Name of the file of verdicts in the folder of `validate --grasps`.
inline constexpr char kVerdictsName[] = "verdicts.npz";

/// Check all grasps of an NPZ file analytically, replay them if requested, and write the verdicts
/// as arrays (docs/formats.md).
/// @returns exit code: whether all of them are on the object and force closure.
/// @throws InputError        a file is broken, or does not fit the object.
/// @throws EnvironmentError  the verdicts cannot be written.
[[nodiscard]] int RunGrasps(const ValidateOptions& options);

/// Name of the file of states in the folder of `validate --export-states`.
inline constexpr char kStatesName[] = "states.npz";

/// Make reset states of a hand that holds an object, and write them as arrays (docs/formats.md).
/// @returns exit code: whether there are as many as requested.
/// @throws InputError        the object is not a solid, or the hand cannot be simulated.
/// @throws EnvironmentError  the states cannot be written.
[[nodiscard]] int RunStates(const ValidateOptions& options);

/// Write the scene of a hand into a folder, and make the folder if it does not exist.
/// @throws EnvironmentError  it cannot be written.
void WriteSceneFolder(const std::string& folder, const std::vector<sim::SceneFile>& files);

}  // namespace regrasp::apps
