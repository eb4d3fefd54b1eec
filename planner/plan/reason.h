#pragma once

#include <string_view>

namespace regrasp::plan {

/// Why a step fails, in the order of the report: where a step has several faults, the first counts.
enum class Reason {
  kNone,
  kOffSurface,
  kWrongNormal,
  kFingerNotFree,
  kFingerNotHolding,
  kTooManyFingers,
  kCoincidentFingers,
  kDiscontinuous,
  kLeavesFace,
  kNotForceClosure,
  kNotProved,
  kUnreachable,
  kSimulationUnstable,
  kContactLost,
  kSlipped,
  kObjectMoved,
  kStartDiffers,
  kGoalNotReached,
};

/// "off-surface" and so on, as the report spells it; empty for kNone.
[[nodiscard]] std::string_view ReasonName(Reason reason);

}  // namespace regrasp::plan
