#pragma once

#include "apps/plan_program.h"

namespace regrasp::apps {

/// Plans for each query of a file of lines (docs/formats.md), in processes that share the objects
/// that were loaded, and writes a file of lines with a plan for each, or why there is none.
/// @returns the exit code, as RunLinesFile.
/// @throws InputError        an option does not go with many plans, or a file as RunLinesFile.
/// @throws EnvironmentError  the output cannot be written.
[[nodiscard]] int RunPlanLines(const PlanProgram& program);

}  // namespace regrasp::apps
