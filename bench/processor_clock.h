#pragma once

#include "planner/base/deadline.h"

namespace regrasp {

/// Return the processor time of this process, s. Other load of the machine has little effect.
[[nodiscard]] double ProcessorSeconds();

/// Return a deadline after `seconds` of this process's processor time from now.
[[nodiscard]] Deadline ProcessorDeadline(double seconds);

}  // namespace regrasp
