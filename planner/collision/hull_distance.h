#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {

/// Return the point that is farthest in a direction, the first of several equally far.
/// @param points  at least one point.
[[nodiscard]] inline const Eigen::Vector3d& Farthest(std::span<const Eigen::Vector3d> points,
                                                     const Eigen::Vector3d& direction) {
  const Eigen::Vector3d* best = points.data();
  double most = best->dot(direction);
  for (const Eigen::Vector3d& point : points) {
    const double reached = point.dot(direction);
    if (reached > most) {
      most = reached;
      best = &point;
    }
  }
  return *best;
}

/// Simplex of one to four points.
struct HullSimplex {
  std::array<Eigen::Vector3d, 4> points;
  int size = 0;
};

/// Return the point of the simplex's hull that is nearest to the origin.
///
/// Corners that this point does not need are removed from the simplex. Four corners remain only if
/// the origin is inside.
[[nodiscard]] Eigen::Vector3d ReduceToNearest(HullSimplex& simplex);

/// Pair of nearest points of two hulls.
struct NearestPair {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// Find the nearest points of the convex hulls of two sets of points.
///
/// The algorithm of Gilbert, Johnson and Keerthi (1988). If it converges, the distance of the two
/// points is the least to a relative 1e-9.
/// @param a, b  at least one point each.
/// @returns the points; nullopt if the hulls meet, up to rounding.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(std::span<const Eigen::Vector3d> a,
                                                           std::span<const Eigen::Vector3d> b);

/// Tree of bounding spheres over points. The farthest point in a direction is found without
/// visiting most of them.
class PointTree {
 public:
  /// Points and a sphere that contains them.
  struct Node {
    int begin = 0;
    int end = 0;
    int right = 0;  ///< right child, the left one is the next node; 0: leaf
    BoundingSphere sphere;
  };

  /// @param points  at least one point. Their order changes if there are more than kLeaf.
  explicit PointTree(std::vector<Eigen::Vector3d> points);

  void Move(const Eigen::Isometry3d& pose);
  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /// Nodes, each before its children.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] std::span<const Eigen::Vector3d> PointsOf(const Node& node) const {
    return std::span(points_).subspan(node.begin, node.end - node.begin);
  }

  inline static constexpr int kLeaf = 8;  ///< most points of a leaf

 private:
  void Build(int begin, int end);

  std::vector<Eigen::Vector3d> points_;
  std::vector<Node> nodes_;
};

/// Return the point that is farthest in a direction.
[[nodiscard]] const Eigen::Vector3d& Farthest(const PointTree& tree,
                                              const Eigen::Vector3d& direction);

/// Find the nearest points of two hulls as FindNearestPoints of spans.
/// @param most  largest distance that matters. If the distance is larger, the result is any pair of
///     points of the hulls, which is farther apart than `most`.
[[nodiscard]] std::optional<NearestPair> FindNearestPoints(const PointTree& a,
                                                           std::span<const Eigen::Vector3d> b,
                                                           double most);

/// Bounds on the distance of two hulls, and the direction of any length from the second hull to the
/// first that has the lower bound.
struct HullBounds : DistanceBounds {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Compute bounds on the distance of the convex hulls of two sets of points, as Distance does for
/// shapes without radii.
/// @param decided  distance; the computation ends as soon as both bounds are on one side of it.
[[nodiscard]] HullBounds HullDistance(std::span<const Eigen::Vector3d> a,
                                      std::span<const Eigen::Vector3d> b,
                                      std::optional<double> decided = std::nullopt);

/// Return whether two hulls are farther apart along a direction than `distance`.
///
/// Cheap if the direction is known, for example from hulls nearby.
[[nodiscard]] bool AreApartAlong(std::span<const Eigen::Vector3d> a,
                                 std::span<const Eigen::Vector3d> b,
                                 const Eigen::Vector3d& direction, double distance);

}  // namespace regrasp::collision
