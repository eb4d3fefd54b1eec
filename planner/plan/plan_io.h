#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/plan/grasp_io.h"  // IWYU pragma: export
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// More fingers than any hand has; a plan file that claims more is bad input.
inline constexpr int kMostFingers = 64;

/// Reads a plan file (docs/plan.schema.json). Nothing is checked against an object here, and
/// nothing that has a Reason: a finger named twice, or outside the hand, is for the checker.
/// @throws InputError  names the file, the element as a JSON pointer, and what is wrong.
[[nodiscard]] Plan ReadPlan(const std::filesystem::path& path);
[[nodiscard]] Plan ParsePlan(std::string_view text, const std::string& name);

/// The text of a plan file: same plan, same bytes; doubles read back as the same bits.
[[nodiscard]] std::string FormatPlan(const Plan& plan);

}  // namespace regrasp::plan
