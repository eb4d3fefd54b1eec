#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace regrasp::collision {

/// Convex hull of points, grown by a radius.
/// A sphere has one point, a capsule two, and a box eight with radius 0. Links of hands and
/// triangles of objects are such shapes.
struct ConvexShape {
  std::vector<Eigen::Vector3d> points;  ///< corners, at least one
  double radius = 0;                    ///< radius, at least 0
};

/// Return a shape moved by a pose.
[[nodiscard]] ConvexShape Moved(const Eigen::Isometry3d& pose, const ConvexShape& shape);

/// Return a shape of few points that contains a shape.
///
/// Points of the shape are selected until their hull is within `tolerance` of all points, the
/// farthest one first. The radius grows by the remaining distance, which is at most `tolerance`.
/// @param shape      shape with at least one point.
/// @param tolerance  largest growth of the radius, > 0.
[[nodiscard]] ConvexShape Enclosing(const ConvexShape& shape, double tolerance);

/// Sphere that contains a shape.
struct BoundingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
};
[[nodiscard]] BoundingSphere BoundingSphereOf(const ConvexShape& shape);

/// Shape at a pose. The shape itself is not moved: it outlives this object.
struct PosedShape {
  const ConvexShape* shape = nullptr;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  BoundingSphere sphere;  ///< bounding sphere of the shape at the pose
};

/// Return a posed shape after another motion.
[[nodiscard]] PosedShape Moved(const Eigen::Isometry3d& motion, const PosedShape& posed);
/// Return the shape itself at the pose.
[[nodiscard]] inline ConvexShape ShapeOf(const PosedShape& posed) {
  return Moved(posed.pose, *posed.shape);
}

/// Certified bounds of the distance of two shapes; 0 if they or their hulls overlap.
struct DistanceBounds {
  double lower = 0;
  double upper = 0;
};

/// Compute the distance of two shapes by the algorithm of Gilbert, Johnson and Keerthi (1988).
/// It is the distance of the hulls minus both radii, at least 0. `lower` is the width of an empty
/// slab between the shapes; it is a valid bound up to rounding even without convergence. `upper` is
/// the distance of two points of the shapes. Both agree to a relative 1e-9 on convergence.
///
/// Laws: the result is symmetric and independent of the order of the points and of rigid motion. An
/// additional point or a larger radius never increases it.
[[nodiscard]] DistanceBounds Distance(const ConvexShape& a, const ConvexShape& b);

/// Return true only if the shapes are certainly farther apart than `distance` ≥ 0.
/// This is faster than Distance because it stops when the answer is known.
[[nodiscard]] bool AreApart(const ConvexShape& a, const ConvexShape& b, double distance);

/// Return true only if two posed shapes are certainly farther apart than `distance` ≥ 0.
/// This is faster than moving the shapes, because most pairs are decided by their bounding spheres
/// or a few points.
[[nodiscard]] bool AreApart(const PosedShape& a, const PosedShape& b, double distance);

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
