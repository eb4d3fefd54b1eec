#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/plan/grasp_io.h"  // IWYU pragma: export
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Largest number of fingers in a plan file, more than any hand has.
inline constexpr int kMostFingers = 64;

/// Read a plan file (docs/plan.schema.json).
/// It is not checked against an object. The checker finds faults that have a Reason, such as a
/// finger that is named twice or is outside the hand.
/// @throws InputError  if the file does not match the schema; names the file and the element as a
///     JSON pointer.
[[nodiscard]] Plan ReadPlan(const std::filesystem::path& path);
[[nodiscard]] Plan ParsePlan(std::string_view text, const std::string& name);

/// Return the text of a plan file.
/// The same plan has the same bytes; doubles read back bit-identically.
[[nodiscard]] std::string FormatPlan(const Plan& plan);

}  // namespace regrasp::plan
