#pragma once

#include <Eigen/Core>

#include "planner/grasp/contact.h"

namespace regrasp {

/// The baseline of force closure: friction cones as pyramids of eight sides inside them.
inline constexpr int kBenchSides = 8;
using PyramidWrenches = Eigen::Matrix<double, 6, 4 * kBenchSides>;

/// The wrenches of the edges of a grasp of four contacts, about the origin.
[[nodiscard]] PyramidWrenches WrenchesOfPyramids(const grasp::Grasp& grasp, double half_angle);

/// Whether a linear program of GLPK finds the pyramids' interiors to balance.
[[nodiscard]] bool PyramidForceClosure(const grasp::Grasp& grasp, double half_angle);

}  // namespace regrasp
