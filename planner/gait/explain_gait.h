#pragma once

#include <string>

#include "planner/gait/find_gait.h"

namespace regrasp::gait {

/// Of a request for which no gait was found: the smallest of some changes with which one is found,
/// in friction, in the size of the object and in the tilt of the palm (where no pose is given),
/// each alone.
///
/// Each change is tried with a twentieth of the grasps that the request may expand, so that what is
/// not named may help none the less. The deadline is of all tries together; progress as in
/// FindGait.
/// @returns as in "would do: a friction of 0.96 instead of 0.8; the object 0.8 times as large", or
///          what was tried in vain.
[[nodiscard]] std::string ExplainGait(const GaitRequest& request);

}  // namespace regrasp::gait
