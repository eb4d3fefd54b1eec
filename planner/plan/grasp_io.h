#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Read a grasp file (docs/grasp.schema.json) and place it on the object.
/// Points are projected onto the surface; an omitted normal is that of the face.
/// @throws InputError  if the file is invalid, a point is farther than the tolerance from the
///     surface, a normal contradicts the surface, or a normal is omitted on a border. The message
///     names the file and the element as a JSON pointer.
[[nodiscard]] grasp::Grasp ReadGrasp(const std::filesystem::path& path,
                                     const object::Object& object);
[[nodiscard]] grasp::Grasp ParseGrasp(std::string_view text, const std::string& name,
                                      const object::Object& object);

/// Return the text of a grasp file.
/// The same grasp has the same bytes; doubles read back bit-identically.
[[nodiscard]] std::string FormatGrasp(const grasp::Grasp& grasp, int dimension);

/// Return a warning about contacts on surface that a repair filled; empty if there are none.
/// It names the first such contact and the number of contacts (Object::IsFilled). Both ends of
/// sliding steps count, the path between them does not.
/// @param projected  plan from ProjectPlan, with faces set.
[[nodiscard]] std::string FilledContactsWarning(const object::Object& object,
                                                const Plan& projected);

}  // namespace regrasp::plan
