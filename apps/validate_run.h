#pragma once

#include <string>
#include <vector>

#include "apps/validate_options.h"
#include "sim/actuation/hand_scene_export.h"

namespace regrasp::apps {

// Modes of `validate`. Each function returns the exit code.

struct ValidationRun {
  int exit_code = 0;
  std::vector<double> entry_seconds;  ///< duration of each step that was replayed
};

/// Validate one plan (`plan_path`) or grasp with the options.
/// This reads the input, checks it, replays it, draws it, writes the files and prints the table.
///
/// The report is written last. If it exists, the other files are complete.
/// @throws InputError        if a file is invalid, or does not fit the options.
/// @throws EnvironmentError  if there is no rendering context, or a folder cannot be written.
[[nodiscard]] ValidationRun RunValidation(const ValidateOptions& options);

/// Validate several plans, each in a separate process and folder.
/// A summary of all plans is written and printed. An error with one plan does not affect the
/// others. If a signal stops a batch, no summary is written.
/// @returns largest exit code of all plans, or 3 if the process of a plan crashed or was stopped.
///     128 plus the signal's number if a signal stopped the batch and this process is alive.
/// @throws InputError        if two plans have the same name, or a folder has no plans.
/// @throws EnvironmentError  if no process can be started, or a folder cannot be written.
[[nodiscard]] int RunBatch(const ValidateOptions& options);

/// Name of the JSON Lines file of reports in the folder of results.
inline constexpr char kReportsName[] = "reports.jsonl";

/// Validate every plan of a JSON Lines file, and write a report for each.
/// The reports are lines of reports.jsonl. The processes share the loaded objects. A plan that gets
/// frames also has a folder, named by its number. The folder has plan.json and the results of a
/// single validation.
/// @returns exit code of RunLinesFile.
/// @throws InputError        as RunLinesFile, or if an output is an input.
/// @throws EnvironmentError  if the folder cannot be written.
[[nodiscard]] int RunValidateLines(const ValidateOptions& options);

/// Name of the file of verdicts in the folder of `validate --grasps`.
inline constexpr char kVerdictsName[] = "verdicts.npz";

/// Check all grasps of an NPZ file analytically, and replay them if requested.
/// The verdicts are written as arrays (docs/formats.md).
/// @returns exit code: kExitDone if all grasps are on the object and force closure.
/// @throws InputError        if a file is invalid, or does not fit the object.
/// @throws EnvironmentError  if the verdicts cannot be written.
[[nodiscard]] int RunGrasps(const ValidateOptions& options);

/// Name of the file of states in the folder of `validate --export-states`.
inline constexpr char kStatesName[] = "states.npz";

/// Make reset states of a hand that holds an object, and write them as arrays.
/// The format is in docs/formats.md.
/// @returns exit code: kExitDone if there are as many as requested.
/// @throws InputError        if the object is not a solid, or the hand cannot be simulated.
/// @throws EnvironmentError  if the states cannot be written.
[[nodiscard]] int RunStates(const ValidateOptions& options);

/// Write the scene of a hand into a folder, which is made if it does not exist.
/// @throws EnvironmentError  if it cannot be written.
void WriteSceneFolder(const std::string& folder, const std::vector<sim::SceneFile>& files);

}  // namespace regrasp::apps
