#include "planner/collision/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

constexpr int kLeafTriangles = 2;

Eigen::AlignedBox3d BoxOf(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box;
}

std::vector<object::Corners> TrianglesOf(const object::Polyhedron& solid, double scale) {
  std::vector<object::Corners> triangles;
  triangles.reserve(solid.triangles().size());
  for (const auto& corners : solid.triangles()) {
    const auto corner = [&](int i) -> Vector3d { return scale * solid.vertices()[corners[i]]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return triangles;
}

/// Visit the triangles that can be nearer to the shape's hull than `within`, until `within` is
/// negative. `on_triangle` can reduce it.
template <class OnTriangle>
void VisitNear(const object::TriangleTree& tree, const ConvexShape& shape, double& within,
               const OnTriangle& on_triangle) {
  const Eigen::AlignedBox3d shape_box = BoxOf(shape.points);
  tree.Visit(
      [&](const Eigen::AlignedBox3d& box) {
        return box.squaredExteriorDistance(shape_box) <= within * within;
      },
      [&](const object::Corners& triangle) {
        on_triangle(triangle);
        return within >= 0;
      });
}

}  // namespace

SurfaceTree::SurfaceTree(const object::Polyhedron& solid, double scale)
    : tree_(TrianglesOf(solid, scale), kLeafTriangles) {
  for (const Vector3d& vertex : solid.vertices()) box_.extend(scale * vertex);
}

double SurfaceTree::DistanceFrom(const ConvexShape& shape, double limit) const {
  double within = limit + shape.radius;
  VisitNear(tree_, shape, within, [&](const object::Corners& triangle) {
    within = std::min(within, HullDistance(shape.points, triangle, std::nullopt).lower);
  });
  return std::max(0.0, within - shape.radius);
}

bool SurfaceTree::IsApart(const ConvexShape& shape, double distance) const {
  const double enough = distance + shape.radius;
  double within = enough;
  // A direction that separates one triangle from the shape often separates nearby triangles too.
  Vector3d direction = Vector3d::Zero();
  VisitNear(tree_, shape, within, [&](const object::Corners& triangle) {
    if (AreApartAlong(shape.points, triangle, direction, enough)) return;
    const HullBounds bounds = HullDistance(shape.points, triangle, enough);
    if (bounds.lower <= enough) within = -1;
    direction = bounds.direction;
  });
  return within >= 0;
}

bool SurfaceTree::IsApart(const PosedShape& posed, double distance) const {
  const double far = posed.sphere.radius + distance;
  if (box_.squaredExteriorDistance(posed.sphere.centre) > far * far) return true;
  return IsApart(ShapeOf(posed), distance);
}

double SurfaceTree::ReachFrom(const Vector3d& point) const {
  double square = 0;
  for (const object::Corners& triangle : tree_.triangles()) {
    for (const Vector3d& corner : triangle) {
      square = std::max(square, (corner - point).squaredNorm());
    }
  }
  return std::sqrt(square);
}

}  // namespace regrasp::collision
