#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/goal_set.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Range of the tolerances of a goal, both ends included.
inline constexpr double kSmallestGoalLength_m = 1e-5;
inline constexpr double kLargestGoalLength_m = 10;
inline constexpr double kSmallestGoalAngle_deg = 0.01;
inline constexpr double kLargestGoalAngle_deg = 180;

/// Return the direction of a name: an axis with an optional sign (`x`, `+x`, `-z`), `up` or `down`.
/// @param up  upward direction in the palm's frame; nullopt: up and down are not accepted.
/// @returns nullopt if there is no direction of that name.
[[nodiscard]] std::optional<Eigen::Vector3d> DirectionOfName(
    const std::string& name, const std::optional<Eigen::Vector3d>& up);

/// Return 1 for `up`, -1 for `down` and 0 for other names (FacingGoal::along_up).
[[nodiscard]] int AlongUp(const std::string& name);

/// Read a goal set: the members `facing`, or `pose` with its tolerances (docs/goals.schema.json).
/// Other members are ignored.
/// @param up  as in DirectionOfName.
/// @throws InputError  if the value does not match the schema.
[[nodiscard]] GoalSet ReadGoalSet(const JsonReader& json, const std::optional<Eigen::Vector3d>& up);
/// Write a goal set. ReadGoalSet returns it again, angles up to 1e-9 degrees.
[[nodiscard]] Json GoalSetJson(const GoalSet& set);

/// Largest number of goals of a list.
inline constexpr std::size_t kMostGoals = 1000;

/// Read a file of goals (docs/format_goals.md).
/// @param up  upward direction in the palm's frame.
/// @throws InputError  if the file cannot be read or does not match docs/goals.schema.json.
[[nodiscard]] std::vector<NamedGoal> ReadGoalList(const std::filesystem::path& path,
                                                  const Eigen::Vector3d& up);
/// Read the text of a file of goals.
/// @param name  name of the file in messages.
[[nodiscard]] std::vector<NamedGoal> ParseGoalList(std::string_view text, const std::string& name,
                                                   const Eigen::Vector3d& up);

/// Read the goals of a plan file.
/// @throws InputError  if a value does not match the schema, the steps decrease, or two goals have
///     the same name.
[[nodiscard]] std::vector<GoalMark> ReadGoalMarks(const JsonReader& json);
[[nodiscard]] Json GoalMarksJson(const std::vector<GoalMark>& marks);

}  // namespace regrasp::plan
