#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Reads a grasp file (docs/grasp.schema.json) and places it on the object: points are projected, a
/// normal that is left out is the face's own.
/// @throws InputError  names the file, the element as a JSON pointer, and what is wrong; also where
///                     a point is farther than the tolerance from the surface, a normal is at odds
///                     with it, or is left out on a border.
[[nodiscard]] grasp::Grasp ReadGrasp(const std::filesystem::path& path,
                                     const object::Object& object);
[[nodiscard]] grasp::Grasp ParseGrasp(std::string_view text, const std::string& name,
                                      const object::Object& object);

/// The text of a grasp file: same grasp, same bytes; doubles read back as the same bits.
[[nodiscard]] std::string FormatGrasp(const grasp::Grasp& grasp, int dimension);

/// What to say of a plan that places fingers on surface that a repair invented
/// (Object::IsInvented): which contact, first of all, and how many; empty where none is there. The
/// ends of aligns count, the way between does not.
/// @param located  the plan as LocatePlan gives it: contacts know their faces.
[[nodiscard]] std::string InventedContactsWarning(const object::Object& object,
                                                  const Plan& located);

}  // namespace regrasp::plan
