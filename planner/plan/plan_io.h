#pragma once

#include <filesystem>
#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// Reads a plan file (docs/plan.schema.json). Nothing is checked against an object here.
/// @throws InputError  names the file, the element as a JSON pointer, and what is wrong.
[[nodiscard]] Plan ReadPlan(const std::filesystem::path& path);
[[nodiscard]] Plan ParsePlan(std::string_view text, const std::string& name);

/// The text of a plan file: same plan, same bytes; doubles read back as the same bits.
[[nodiscard]] std::string FormatPlan(const Plan& plan);

/// Reads a grasp file and places it on the object: points are projected, a normal that is left out
/// is the face's own.
/// @throws InputError  also where a point is farther than the tolerance from the surface, a normal
///                     is at odds with it, or is left out on a border.
[[nodiscard]] Grasp ReadGrasp(const std::filesystem::path& path, const Object& object);
[[nodiscard]] Grasp ParseGrasp(std::string_view text, const std::string& name,
                               const Object& object);
[[nodiscard]] std::string FormatGrasp(const Grasp& grasp, int dimension);

}  // namespace regrasp
