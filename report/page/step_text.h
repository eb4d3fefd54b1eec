#pragma once

#include <string>

#include "planner/plan/plan.h"

namespace regrasp::report {

/// The title of an entry with an upper-case first letter: "Switch: place 4, release 0".
[[nodiscard]] std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index);

/// "the hold", "step 3".
[[nodiscard]] std::string StepName(plan::EntryIndex index);

/// The text with an upper-case first letter, if that is an ASCII one.
[[nodiscard]] std::string Capitalized(std::string text);

}  // namespace regrasp::report
