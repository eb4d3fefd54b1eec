#pragma once

#include <string>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// ± a force along every axis, then ± a torque about every axis: twelve in space; in the plane the
/// six along x and y and about z.
[[nodiscard]] std::vector<Push> PushDirections(int dimension);

/// "force +x", "torque -z".
[[nodiscard]] std::string PushName(const Push& push);

/// "a push of 5.3 N along +x", "a twist of 0.2 N·m about -z".
/// @param size    of the force, or of the torque over `radius`, newtons.
/// @param radius  metres.
[[nodiscard]] std::string PushText(const Push& push, double size, double radius);

/// A force of `size`, or a torque of `size` times the frame's radius.
[[nodiscard]] grasp::Wrench PushWrench(const Push& push, double size);

}  // namespace regrasp::sim
