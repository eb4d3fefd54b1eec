#include "planner/collision/convex_shape.h"

#include <algorithm>

#include "planner/collision/hull_distance.h"

namespace regrasp::collision {

using Eigen::Vector3d;

ConvexShape Moved(const Eigen::Isometry3d& pose, const ConvexShape& shape) {
  ConvexShape moved = shape;
  for (Vector3d& point : moved.points) point = pose * point;
  return moved;
}

BoundingSphere BoundingSphereOf(const ConvexShape& shape) {
  Vector3d lower = shape.points.front();
  Vector3d upper = lower;
  for (const Vector3d& point : shape.points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  BoundingSphere ball{(lower + upper) / 2, 0};
  for (const Vector3d& point : shape.points) {
    ball.radius = std::max(ball.radius, (point - ball.centre).norm());
  }
  ball.radius += shape.radius;
  return ball;
}

DistanceBounds Distance(const ConvexShape& a, const ConvexShape& b) {
  const DistanceBounds hulls = HullDistance(a.points, b.points);
  const double radii = a.radius + b.radius;
  return {std::max(0.0, hulls.lower - radii), std::max(0.0, hulls.upper - radii)};
}

bool AreApart(const ConvexShape& a, const ConvexShape& b, double distance) {
  const double enough = distance + a.radius + b.radius;
  return HullDistance(a.points, b.points, enough).lower > enough;
}

}  // namespace regrasp::collision
