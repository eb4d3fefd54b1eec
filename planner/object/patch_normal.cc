#include "planner/object/patch_normal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "planner/object/closest_on_segment.h"
#include "planner/object/polyhedron.h"

namespace regrasp::object {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Compute the signed area of the intersection of the triangle (0, a, b) with a disc about 0.
double AreaInDisc(const Vector2d& a, const Vector2d& b, double radius_squared) {
  const auto sector = [&](const Vector2d& from, const Vector2d& to) {
    return radius_squared / 2 * std::atan2(Cross(from, to), from.dot(to));
  };
  // Intersection of the line a + t (b − a) with the circle.
  const Vector2d along = b - a;
  const double length_squared = along.squaredNorm();
  const double half = a.dot(along);
  const double root = half * half - length_squared * (a.squaredNorm() - radius_squared);
  if (!(root > 0)) return sector(a, b);
  const double enters = (-half - std::sqrt(root)) / length_squared;
  const double leaves = (-half + std::sqrt(root)) / length_squared;
  if (enters >= 1 || leaves <= 0) return sector(a, b);
  const Vector2d from = enters > 0 ? Vector2d(a + enters * along) : a;
  const Vector2d to = leaves < 1 ? Vector2d(a + leaves * along) : b;
  return (enters > 0 ? sector(a, from) : 0) + Cross(from, to) / 2 +
         (leaves < 1 ? sector(to, b) : 0);
}

/// Triangles near a point, with their adjacency.
class Neighbourhood {
 public:
  Neighbourhood(const Polyhedron& solid, const Vector3d& point, double radius)
      : solid_(solid), point_(point), radius_(radius) {
    for (const FaceIndex face : solid.FacesNear(point, radius)) {
      for (const TriangleIndex t : solid.TrianglesOf(face)) {
        if (MayMeet(t)) AddSides(t);
      }
    }
    std::ranges::sort(sides_);
  }

  /// Return the sum of area times inward normal over the triangles connected with the given one.
  [[nodiscard]] Vector3d SumFrom(TriangleIndex first) const {
    std::vector<TriangleIndex> reached = {first};
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const TriangleIndex t = reached[i];
      sum += AreaOf(t) * solid_.inward_normal(solid_.face_of_triangle(t));
      for (int k = 0; k < 3; ++k) {
        const TriangleIndex next = Beyond(t, k);
        if (next.valid() && !std::ranges::count(reached, next)) reached.push_back(next);
      }
    }
    return sum;
  }

 private:
  /// Side of a triangle, smaller vertex first.
  using Side = std::tuple<int, int, TriangleIndex>;

  [[nodiscard]] const Vector3d& Corner(TriangleIndex t, int k) const {
    return solid_.vertices()[solid_.triangles()[t][k % 3]];
  }

  [[nodiscard]] bool MayMeet(TriangleIndex t) const {
    const Vector3d low = Corner(t, 0).cwiseMin(Corner(t, 1)).cwiseMin(Corner(t, 2));
    const Vector3d high = Corner(t, 0).cwiseMax(Corner(t, 1)).cwiseMax(Corner(t, 2));
    return ((low - point_).array() <= radius_).all() && ((point_ - high).array() <= radius_).all();
  }

  [[nodiscard]] Side SideOf(TriangleIndex t, int k) const {
    const auto [low, high] =
        std::minmax(solid_.triangles()[t][k], solid_.triangles()[t][(k + 1) % 3]);
    return {low, high, t};
  }

  void AddSides(TriangleIndex t) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d at = ClosestOnSegment(Corner(t, k), Corner(t, k + 1), point_);
      if ((at - point_).norm() <= radius_) sides_.push_back(SideOf(t, k));
    }
  }

  /// Return the triangle across a side; invalid if the side is outside the ball.
  [[nodiscard]] TriangleIndex Beyond(TriangleIndex t, int k) const {
    const Side own = SideOf(t, k);
    const auto [low, high, unused] = own;
    auto at = std::ranges::lower_bound(sides_, Side{low, high, TriangleIndex(0)});
    for (; at != sides_.end() && std::get<0>(*at) == low && std::get<1>(*at) == high; ++at) {
      if (std::get<2>(*at) != t) return std::get<2>(*at);
    }
    return {};
  }

  /// Compute the area of the part of a triangle inside the ball.
  [[nodiscard]] double AreaOf(TriangleIndex t) const {
    const Vector3d& n = solid_.inward_normal(solid_.face_of_triangle(t));
    const double height = n.dot(point_ - Corner(t, 0));
    const double radius_squared = radius_ * radius_ - height * height;
    if (!(radius_squared > 0)) return 0;
    const Vector3d u = n.unitOrthogonal();
    const Vector3d v = n.cross(u);
    std::array<Vector2d, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector3d from_point = Corner(t, k) - point_;
      corners[k] = {u.dot(from_point), v.dot(from_point)};
    }
    double area = 0;
    for (int k = 0; k < 3; ++k) {
      area += AreaInDisc(corners[k], corners[(k + 1) % 3], radius_squared);
    }
    return std::abs(area);
  }

  const Polyhedron& solid_;
  Vector3d point_;
  double radius_;
  std::vector<Side> sides_;  ///< sides that intersect the ball, sorted by vertices
};

/// Return the distance of a point from a triangle within the triangle's plane; 0 inside.
double DistanceBeside(const Polyhedron& solid, TriangleIndex t, const Vector3d& point) {
  const Vector3d& n = solid.inward_normal(solid.face_of_triangle(t));
  double farthest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d& a = solid.vertices()[solid.triangles()[t][k]];
    const Vector3d& b = solid.vertices()[solid.triangles()[t][(k + 1) % 3]];
    // Because n points inward, the triangle is on the left of its sides as seen from outside.
    const Vector3d outwards = (b - a).cross(-n);
    const double length = outwards.norm();
    if (length > 0) farthest = std::max(farthest, outwards.dot(point - a) / length);
  }
  return farthest;
}

}  // namespace

Vector3d PatchNormal(const Polyhedron& solid, FaceIndex face, const Vector3d& point,
                     double radius) {
  if (solid.DistanceToBorder(face, point) >= radius) return solid.inward_normal(face);
  const Neighbourhood about(solid, point, radius);
  const auto& own = solid.TrianglesOf(face);
  const TriangleIndex under = *std::ranges::min_element(
      own, {}, [&](TriangleIndex t) { return DistanceBeside(solid, t, point); });
  const Vector3d sum = about.SumFrom(under);
  // The normals cancel only if the patch has two opposite sides, as a thin blade. Neither is its
  // normal.
  return sum.norm() > 0 ? Vector3d(sum.normalized()) : solid.inward_normal(face);
}

}  // namespace regrasp::object
