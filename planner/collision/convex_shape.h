#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace regrasp::collision {

/// The convex hull of some points, grown by a radius: a ball is one point, a capsule two, a box
/// eight without a radius. Links of hands are such shapes, and so is a triangle of an object.
struct ConvexShape {
  std::vector<Eigen::Vector3d> points;  ///< at least one
  double radius = 0;                    ///< not negative
};

/// The same shape moved.
[[nodiscard]] ConvexShape Moved(const Eigen::Isometry3d& pose, const ConvexShape& shape);

/// A ball that contains the shape.
struct BoundingSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
};
[[nodiscard]] BoundingSphere BoundingSphereOf(const ConvexShape& shape);

/// Certified bounds on the distance of two shapes: 0 where they overlap or their hulls do.
struct DistanceBounds {
  double lower = 0;
  double upper = 0;
};

/// The distance of the hulls of two sets of points less both radii, at least 0, by the algorithm of
/// Gilbert, Johnson and Keerthi (1988). `lower` is the width of an empty slab between the shapes
/// along a direction that was found and so holds up to rounding whatever the algorithm did;
/// `upper` is that of two points of theirs. They meet within a relative 1e-9 where it converges.
///
/// Laws: independent of the order of the points and of rigid motion; symmetric; a point more or a
/// larger radius never enlarges the distance.
[[nodiscard]] DistanceBounds Distance(const ConvexShape& a, const ConvexShape& b);

/// True only where the shapes are certainly farther apart than `distance` (not negative). Faster
/// than Distance: it ends as soon as the answer is known.
[[nodiscard]] bool AreApart(const ConvexShape& a, const ConvexShape& b, double distance);

}  // namespace regrasp::collision
