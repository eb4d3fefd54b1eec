#pragma once

#include <string>
#include <vector>

#include "report/report.h"
#include "sim/scene/settings.h"

namespace regrasp::report {

/// Return the limits that the verdict of a replay by a hand relies on, as one line for people:
/// "torque 1 N·m, 16 control ranges, 16 joint ranges".
[[nodiscard]] std::string LimitsText(const std::vector<sim::DriveLimits>& limits);

/// Add what the verdict of a replay by a hand takes for granted: actuators without a force limit,
/// and fingertips whose geometry is in the object because a sphere stands for it.
void AddHandWarnings(const Report& report, std::vector<std::string>& warnings);

}  // namespace regrasp::report
