#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace regrasp::collision {

/// Convex hull of points, grown by a radius.
/// A sphere has one point, a capsule two, and a box eight with radius 0. Links of hands and
/// triangles of objects are such shapes.
struct ConvexShape {
  std::vector<Eigen::Vector3d> points;  ///< at least one point
  double radius = 0;                    ///< at least 0
};

/// Return a shape moved by a pose.
[[nodiscard]] ConvexShape Moved(const Eigen::Isometry3d& pose, const ConvexShape& shape);

/// Sphere that contains a shape.
struct BoundingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
};
[[nodiscard]] BoundingSphere BoundingSphereOf(const ConvexShape& shape);

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

}  // namespace regrasp::collision
