#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace regrasp::sim {

/// Convex hull of points, extended by a radius.
struct ConvexBody {
  std::vector<Eigen::Vector3d> points;
  double radius = 0;
  /// Bounding sphere.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double reach = 0;
  Eigen::AlignedBox3d box = {};  ///< bounding box of the points
};

/// Make a convex body with its bounding sphere and box.
[[nodiscard]] ConvexBody MakeConvexBody(std::vector<Eigen::Vector3d> points, double radius);

/// Return a body at another pose.
[[nodiscard]] ConvexBody Moved(const Eigen::Isometry3d& pose, ConvexBody solid);

/// Return whether two solids are certainly more than `gap` apart.
/// A negative gap allows overlap by less than that, as far as the radii extend. The pairwise
/// Frank-Wolfe method (Lacoste-Julien and Jaggi 2015) moves towards the nearest points of the hulls
/// until a separating plane proves the gap.
[[nodiscard]] bool HaveGap(const ConvexBody& a, const ConvexBody& b, double gap);

/// Gap between two objects for messages, to about a thousandth.
struct Nearness {
  /// Negative if they overlap: distance by which the first must move to be free, along the best of
  /// several directions.
  double gap = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< point between the nearest points
};

/// Return the gap between a solid and the nearest of several solids.
/// For a solid deep inside another, only the hulls' radii count, and the actual gap is at least the
/// result; FreeingDistance is more precise.
/// @param others  solids, at least one.
[[nodiscard]] Nearness NearestOf(const ConvexBody& solid, std::span<const ConvexBody> others);

/// Return the distance by which a solid must move to be free of other solids.
/// It is that of the best direction, to 1 % but no finer than 1 µm.
/// @param directions  unit vectors.
[[nodiscard]] double FreeingDistance(const ConvexBody& solid, std::span<const ConvexBody> others,
                                     std::span<const Eigen::Vector3d> directions);

}  // namespace regrasp::sim
