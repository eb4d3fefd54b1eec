#pragma once

#include <string>

#include "planner/plan/check.h"

namespace regrasp::plan {

/// Expect that exactly the entry `index` fails, with `reason`, and that later entries are skipped.
void ExpectFails(const PlanCheck& check, int index, Reason reason, const std::string& name);

/// Expect that every entry passes and is proved throughout.
void ExpectPasses(const PlanCheck& check, const std::string& name);

}  // namespace regrasp::plan
