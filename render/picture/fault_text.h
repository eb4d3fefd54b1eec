#pragma once

#include <string>

#include "planner/plan/reason.h"

namespace regrasp::render {

/// What failed in a line, with its number and unit: "finger 2 is 4.1 mm off the surface", "the
/// grasp needs 7.34°, has 6.00°". Where the fault has no number it is the detail.
/// @param detail           of the check or the replay.
/// @param metres_per_unit  of the object.
[[nodiscard]] std::string FaultText(plan::Reason reason, const plan::Fault& fault,
                                    const std::string& detail, double metres_per_unit);

/// A half-angle for people: "7.34°".
[[nodiscard]] std::string FormatDegrees(double radians);

/// A push for people: "a push of 5.3 N", "a twist of 0.2 N·m".
[[nodiscard]] std::string PushText(const plan::FaultPush& push);

}  // namespace regrasp::render
