#pragma once

#include "planner/base/deadline.h"

namespace regrasp {

/// Processor time of this process, seconds: other work on the machine hardly counts.
[[nodiscard]] double ProcessorSeconds();

/// After so many seconds of this process's processor time from now.
[[nodiscard]] Deadline ProcessorDeadline(double seconds);

}  // namespace regrasp
