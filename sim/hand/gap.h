#pragma once

#include <Eigen/Core>
#include <vector>

namespace regrasp::sim {

/// The hull of some points, grown by a radius, where it is.
struct Solid {
  std::vector<Eigen::Vector3d> points;
  double radius = 0;
  /// A ball that contains it.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double reach = 0;
};

/// With its ball.
[[nodiscard]] Solid MakeSolid(std::vector<Eigen::Vector3d> points, double radius);

/// True only where two solids are certainly more than `gap` apart (negative: overlap by less than
/// that, as far as the radii go). By the pairwise Frank-Wolfe method (Lacoste-Julien and Jaggi
/// 2015), which goes to the nearest points of the hulls, until a plane between them shows it.
[[nodiscard]] bool HaveGap(const Solid& a, const Solid& b, double gap);

}  // namespace regrasp::sim
