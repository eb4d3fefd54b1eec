#pragma once

#include <span>

#include "planner/plan/failure_reasons.h"

namespace regrasp::apps {

/// Return all failure reasons of `evaluate` in the order of their checks (sim::GraspFault).
[[nodiscard]] std::span<const plan::FailureReason> EvaluateReasons();

}  // namespace regrasp::apps
