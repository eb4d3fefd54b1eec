#pragma once

#include <string>

#include "sim/scene/settings.h"

namespace regrasp::report {

/// The squeeze and why it is what it is: "2119 N, 1000 times the weight: …".
[[nodiscard]] std::string SqueezeText(const sim::ReplaySettings& settings);

}  // namespace regrasp::report
