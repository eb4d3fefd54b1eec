#pragma once

#include <string>

#include "planner/plan/check.h"

namespace regrasp::plan {

/// Expects that exactly the entry `index` fails, with `reason`, and that later ones are skipped.
void ExpectFails(const PlanCheck& check, int index, Reason reason, const std::string& name);

/// Expects that every entry passes and is proved throughout.
void ExpectPasses(const PlanCheck& check, const std::string& name);

}  // namespace regrasp::plan
