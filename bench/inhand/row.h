#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/inhand/judge.h"
#include "bench/inhand/plan_task.h"

namespace regrasp::bench {

/// Reasons of rows beside those of plan::Reason.
inline constexpr char kNoPlan[] = "no-plan";
inline constexpr char kNoStart[] = "no-start";  ///< the task before it has no plan that goes on
inline constexpr char kCrash[] = "crash";       ///< the planner or the judge ended by itself

/// What became of a task in a hand: a line of the results, which are JSON Lines.
struct Row {
  std::string task, group, body, hand, hand_sha256;
  std::string planner = "gait";
  std::optional<double> limit_s, seconds;  ///< of the processor; none of plans of others
  bool found = false;
  int switches = 0, moves = 0, aligns = 0;
  bool passed = false;
  std::string reason, detail;  ///< of a failure
  std::optional<PoseError> error;
  std::string plan_sha256;  ///< of the plan file's bytes
};

/// What a row says of the task, the hand and nothing else.
[[nodiscard]] Row RowOf(const Task& task, const kinematics::HandFile& hand);

/// Adds what a plan is and what the judge says. @param bytes  of its file.
void AddPlan(const plan::Plan& plan, std::string_view bytes, const Verdict& verdict, Row& row);

/// One line of JSON, with its end.
[[nodiscard]] std::string FormatRow(const Row& row);

/// @throws InputError  names the line and the element.
[[nodiscard]] std::vector<Row> ParseRows(std::string_view text, const std::string& name);

/// The rows of a file, none where there is no file; of rows for one task, hand and planner only the
/// last one.
[[nodiscard]] std::vector<Row> ReadRows(const std::filesystem::path& path);

/// @throws EnvironmentError  it cannot be written.
void AppendRows(const std::filesystem::path& path, std::string_view lines);

}  // namespace regrasp::bench
