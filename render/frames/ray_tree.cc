#include "render/frames/ray_tree.h"

#include <algorithm>
#include <limits>

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 4;  ///< triangles
/// A tree of 2³¹ triangles, halved at every node, is no deeper.
constexpr int kDeepest = 32;

/// What of a ray may still be met.
struct Ray {
  Ray(const Vector3d& origin, const Vector3d& direction, double skip)
      : origin(origin), direction(direction), inverse(direction.cwiseInverse()), from(skip) {}

  const Vector3d& origin;
  const Vector3d& direction;
  const Vector3d inverse;
  double from;

  [[nodiscard]] bool Meets(const Eigen::AlignedBox3d& box, double to) const {
    double near = from;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {  // zero times infinity otherwise, in the plane of a side
        if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return false;
        continue;
      }
      const double a = (box.min()[axis] - origin[axis]) * inverse[axis];
      const double b = (box.max()[axis] - origin[axis]) * inverse[axis];
      near = std::max(near, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return near <= to;
  }

  /// Infinite where it does not meet the triangle.
  [[nodiscard]] double DistanceTo(const std::array<Vector3d, 3>& triangle) const {
    // Möller and Trumbore 1997.
    const auto& [a, b, c] = triangle;
    const Vector3d u = b - a;
    const Vector3d v = c - a;
    const Vector3d p = direction.cross(v);
    const double determinant = u.dot(p);
    const Vector3d s = origin - a;
    const double alpha = s.dot(p) / determinant;
    const Vector3d q = s.cross(u);
    const double beta = direction.dot(q) / determinant;
    const double distance = v.dot(q) / determinant;
    const bool met = determinant != 0 && alpha >= 0 && beta >= 0 && alpha + beta <= 1;
    return met && distance > from ? distance : std::numeric_limits<double>::infinity();
  }
};

}  // namespace

RayTree::RayTree(const FacetMesh& mesh) : triangles_(mesh.triangles) {
  if (!triangles_.empty()) Split(0, static_cast<int>(triangles_.size()));
}

void RayTree::Split(int begin, int end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, begin, end});
  Eigen::AlignedBox3d middles;
  for (int i = begin; i < end; ++i) {
    for (const Vector3d& p : triangles_[i]) nodes_[node].box.extend(p);
    middles.extend(Vector3d(triangles_[i][0] + triangles_[i][1] + triangles_[i][2]));
  }
  if (end - begin <= kLeaf) return;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const int half = (begin + end) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + half, triangles_.begin() + end,
                   [axis](const Triangle& a, const Triangle& b) {
                     return a[0][axis] + a[1][axis] + a[2][axis] <
                            b[0][axis] + b[1][axis] + b[2][axis];
                   });
  Split(begin, half);
  nodes_[node].right = static_cast<int>(nodes_.size());
  Split(half, end);
}

/// @param take  called with the distance to a triangle that is met; returns up to where further
/// ones
///              count, negative for nowhere.
template <class Ray, class Take>
void RayTree::Visit(const Ray& ray, const Take& take) const {
  if (nodes_.empty()) return;
  std::array<int, kDeepest> open = {0};
  double to = std::numeric_limits<double>::infinity();
  for (int count = 1; count > 0;) {
    const int index = open[--count];
    const Node& node = nodes_[index];
    if (!ray.Meets(node.box, to)) continue;
    if (node.right >= 0) {
      open[count++] = node.right;
      open[count++] = index + 1;
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const double distance = ray.DistanceTo(triangles_[i]);
      if (distance < to) to = take(distance);
    }
  }
}

double RayTree::Distance(const Vector3d& origin, const Vector3d& direction, double skip) const {
  double nearest = std::numeric_limits<double>::infinity();
  Visit(Ray(origin, direction, skip), [&nearest](double distance) { return nearest = distance; });
  return nearest;
}

int RayTree::CountHits(const Vector3d& origin, const Vector3d& direction, double skip,
                       int most) const {
  int hits = 0;
  Visit(Ray(origin, direction, skip),
        [&](double) { return ++hits < most ? std::numeric_limits<double>::infinity() : -1; });
  return hits;
}

bool IsMet(const std::vector<PlacedRays>& surfaces, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& direction, double skip) {
  return std::ranges::any_of(surfaces, [&](const PlacedRays& surface) {
    const auto& [rays, to_rays] = surface;
    return rays->CountHits(to_rays * origin, to_rays.linear() * direction, skip, 1) > 0;
  });
}

}  // namespace regrasp::render
