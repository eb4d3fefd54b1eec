#pragma once

#include <string>
#include <vector>

#include "sim/validation/validation_report.h"

namespace regrasp::validation {

/// Result of a hand replay in one engine.
struct EngineResult {
  std::string engine;       ///< name of the engine: "MuJoCo"
  bool passed = true;       ///< whether all steps of the plan pass
  plan::EntryIndex failed;  ///< first step that fails; not valid if none does
  std::string detail;       ///< description of the violation
  double off_m = 0;         ///< largest distance of the object's centroid from the plan
  double off_rad = 0;       ///< largest rotation of the object from the plan
  double margin = 1;        ///< smallest tolerance margin of all steps (sim::ToleranceMargin)
};

/// Return the results of MuJoCo and ODE in a hand replay in both.
/// Steps after the first failure in MuJoCo are in neither. The result is empty for other replays.
[[nodiscard]] std::vector<EngineResult> EngineResultsOf(const Report& report);

}  // namespace regrasp::validation
