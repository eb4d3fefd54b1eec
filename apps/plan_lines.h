#pragma once

#include "apps/plan_program.h"

namespace regrasp::apps {

/// Plan for each query of a JSON Lines file (docs/formats.md).
/// The processes share the loaded objects. The output is a JSON Lines file with a plan, or the
/// reason that none was found, for each query.
/// @returns exit code of RunLinesFile.
/// @throws InputError        if an option cannot be used with several plans, or as RunLinesFile.
/// @throws EnvironmentError  if the output cannot be written.
[[nodiscard]] int RunPlanLines(const PlanProgram& program);

}  // namespace regrasp::apps
