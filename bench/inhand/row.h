#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/inhand/judge.h"
#include "bench/inhand/plan_task.h"

namespace regrasp::bench {

/// Reasons of rows in addition to those of plan::Reason.
inline constexpr char kNoPlan[] = "no-plan";
inline constexpr char kNoStart[] = "no-start";  ///< the task before it has no plan to continue
inline constexpr char kCrash[] = "crash";       ///< the process of the planner or evaluator crashed

/// Result of a task in a hand: one line of the results, which are JSON Lines.
struct Row {
  std::string task, group, body, hand, hand_sha256;
  std::string planner = "gait";
  std::optional<double> limit_s, seconds;  ///< processor time, s; none for third-party plans
  bool found = false;
  int switches = 0, moves = 0, aligns = 0;
  bool passed = false;
  std::string reason, detail;  ///< failure
  std::optional<PoseError> error;
  std::string plan_sha256;  ///< digest of the plan file's bytes
};

/// Return a row with the data of the task and the hand only.
[[nodiscard]] Row RowOf(const Task& task, const kinematics::HandFile& hand);

/// Add the properties and the verdict of a plan. @param bytes  bytes of its file.
void AddPlan(const plan::Plan& plan, std::string_view bytes, const Verdict& verdict, Row& row);

/// Return one line of JSON, with its line end.
[[nodiscard]] std::string FormatRow(const Row& row);

/// @throws InputError  if a row is invalid; the message names the line and the element.
[[nodiscard]] std::vector<Row> ParseRows(std::string_view text, const std::string& name);

/// Read the rows of a file; none if there is no file. If several rows are for one task, hand and
/// planner, only the last one counts.
[[nodiscard]] std::vector<Row> ReadRows(const std::filesystem::path& path);

/// @throws EnvironmentError  if the file cannot be written.
void AppendRows(const std::filesystem::path& path, std::string_view lines);

}  // namespace regrasp::bench
