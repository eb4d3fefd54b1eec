#pragma once

#include <string>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// What to say of a plan that places fingers on surface that a repair invented
/// (Object::IsInvented): which contact, first of all, and how many; empty where none is there. The
/// ends of aligns count, the way between does not.
/// @param located  the plan as LocatePlan gives it: contacts know their faces.
[[nodiscard]] std::string InventedContactsWarning(const object::Object& object,
                                                  const Plan& located);

}  // namespace regrasp::plan
