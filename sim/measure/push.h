#pragma once

#include <string>
#include <vector>

#include "planner/grasp/grasp_forces.h"

namespace regrasp::sim {

/// A direction in which an object at rest is pushed or turned.
struct Push {
  bool turn = false;  ///< about the axis, instead of along it
  int axis = 0;       ///< 0 x, 1 y, 2 z
  double sign = 1;    ///< +1 or −1
};

/// ± a force along every axis, then ± a torque about every axis: twelve in space; in the plane the
/// six along x and y and about z.
[[nodiscard]] std::vector<Push> PushDirections(int dimension);

/// "force +x", "torque -z".
[[nodiscard]] std::string PushName(const Push& push);

/// A force of `size`, or a torque of `size` times the frame's radius.
[[nodiscard]] Wrench PushWrench(const Push& push, double size);

}  // namespace regrasp::sim
