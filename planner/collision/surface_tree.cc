#include "planner/collision/surface_tree.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>

#include "planner/collision/convex_shape.h"

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

constexpr int kLeafTriangles = 2;
constexpr int kDeepest = 64;

Vector3d CentreOf(const std::array<Vector3d, 3>& triangle) {
  return (triangle[0] + triangle[1] + triangle[2]) / 3;
}

Eigen::AlignedBox3d BoxOf(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(point);
  return box;
}

}  // namespace

SurfaceTree::SurfaceTree(const object::Polyhedron& solid, double scale) {
  triangles_.reserve(solid.triangles().size());
  for (const auto& corners : solid.triangles()) {
    const auto corner = [&](int i) -> Vector3d { return scale * solid.vertices()[corners[i]]; };
    triangles_.push_back({corner(0), corner(1), corner(2)});
  }
  Build(0, static_cast<int>(triangles_.size()));
}

int SurfaceTree::Build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  Node node{{}, begin, end};
  Eigen::AlignedBox3d centres;
  for (int i = begin; i < end; ++i) {
    for (const Vector3d& corner : triangles_[i]) node.box.extend(corner);
    centres.extend(CentreOf(triangles_[i]));
  }
  nodes_.push_back(node);
  if (end - begin > kLeafTriangles) {
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                     triangles_.begin() + end, [axis](const Triangle& a, const Triangle& b) {
                       return CentreOf(a)[axis] < CentreOf(b)[axis];
                     });
    Build(begin, middle);
    nodes_[index].right = Build(middle, end);
  }
  return index;
}

/// Call `on_leaf` for triangles that can be nearer to the shape's hull than `within`.
/// `on_leaf` can reduce `within`.
template <typename OnLeaf>
void SurfaceTree::Descend(const ConvexShape& shape, const OnLeaf& on_leaf, double& within) const {
  const Eigen::AlignedBox3d box = BoxOf(shape.points);
  boost::container::static_vector<int, kDeepest> waiting = {0};
  while (!waiting.empty()) {
    const int index = waiting.back();
    const Node& node = nodes_[index];
    waiting.pop_back();
    if (node.box.squaredExteriorDistance(box) > within * within) continue;
    if (node.right == 0) {
      for (int i = node.begin; i < node.end; ++i) on_leaf(triangles_[i]);
      if (within < 0) return;
      continue;
    }
    waiting.push_back(node.right);
    waiting.push_back(index + 1);
  }
}

double SurfaceTree::DistanceFrom(const ConvexShape& shape, double limit) const {
  double within = limit + shape.radius;
  Descend(
      shape,
      [&](const Triangle& triangle) {
        within = std::min(within, HullDistance(shape.points, triangle, std::nullopt).lower);
      },
      within);
  return std::max(0.0, within - shape.radius);
}

bool SurfaceTree::IsApart(const ConvexShape& shape, double distance) const {
  const double enough = distance + shape.radius;
  double within = enough;
  // A direction that separates one triangle from the shape often separates nearby triangles too.
  Vector3d direction = Vector3d::Zero();
  Descend(
      shape,
      [&](const Triangle& triangle) {
        if (AreApartAlong(shape.points, triangle, direction, enough)) return;
        const HullBounds bounds = HullDistance(shape.points, triangle, enough);
        if (bounds.lower <= enough) within = -1;
        direction = bounds.direction;
      },
      within);
  return within >= 0;
}

double SurfaceTree::ReachFrom(const Vector3d& point) const {
  double square = 0;
  for (const Triangle& triangle : triangles_) {
    for (const Vector3d& corner : triangle) {
      square = std::max(square, (corner - point).squaredNorm());
    }
  }
  return std::sqrt(square);
}

}  // namespace regrasp::collision
