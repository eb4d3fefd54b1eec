#pragma once

#include <Eigen/Core>

#include "planner/grasp/contact.h"

namespace regrasp {

/// Number of sides of the baseline's pyramids, which are inscribed in the friction cones.
inline constexpr int kBenchSides = 8;
using PyramidWrenches = Eigen::Matrix<double, 6, 4 * kBenchSides>;

/// Return the wrenches of the pyramids' edges for a grasp of four contacts, about the origin.
[[nodiscard]] PyramidWrenches WrenchesOfPyramids(const grasp::Grasp& grasp, double friction_angle);

/// Return true if a linear program of GLPK finds that the interiors of the pyramids balance.
[[nodiscard]] bool PyramidForceClosure(const grasp::Grasp& grasp, double friction_angle);

}  // namespace regrasp
