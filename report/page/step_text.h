#pragma once

#include <string>

#include "planner/plan/plan.h"

namespace regrasp::report {

/// The title of an entry with an upper-case first letter: "Switch: place 4, release 0".
[[nodiscard]] std::string StepTitle(const plan::Plan& plan, plan::EntryIndex index);

/// "the hold", "step 3".
[[nodiscard]] std::string StepName(plan::EntryIndex index);

/// Two sentences that go on after what failed, each with a space before it; none where both are
/// empty.
[[nodiscard]] std::string WhyAndMend(const std::string& why, const std::string& mend);

/// The text with an upper-case first letter, if that is an ASCII one.
[[nodiscard]] std::string Capitalized(std::string text);

}  // namespace regrasp::report
