#include "planner/collision/ball_contact.h"

#include <algorithm>
#include <cmath>

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

/// Distance within which points are identical, metres.
constexpr double kSamePoint = 1e-9;

/// Return the nearest point of a triangle (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vector3d ClosestOnTriangle(const Vector3d& p, const std::array<Vector3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace

BallContact::BallContact(const object::Polyhedron& solid, double scale) {
  for (const auto& [a, b, c] : solid.triangles()) {
    Triangle triangle{
        {scale * solid.vertices()[a], scale * solid.vertices()[b], scale * solid.vertices()[c]},
        Vector3d::Zero(),
        Vector3d::Zero(),
        0};
    const auto& corners = triangle.corners;
    triangle.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    for (const Vector3d& corner : triangle.corners) triangle.middle += corner / 3;
    for (const Vector3d& corner : triangle.corners) {
      triangle.radius = std::max(triangle.radius, (corner - triangle.middle).norm());
    }
    triangles_.push_back(triangle);
  }
}

Vector3d BallContact::ClosestOn(int triangle, const Vector3d& point) const {
  return ClosestOnTriangle(point, triangles_[triangle].corners);
}

std::vector<int> BallContact::Around(const Vector3d& centre, double reach) const {
  std::vector<int> near;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const double limit = triangles_[i].radius + reach;
    if ((triangles_[i].middle - centre).squaredNorm() <= limit * limit) {
      near.push_back(static_cast<int>(i));
    }
  }
  return near;
}

std::vector<NearPoint> BallContact::Find(const Vector3d& centre, double reach) const {
  return Find(centre, reach, Around(centre, reach));
}

std::vector<NearPoint> BallContact::Find(const Vector3d& centre, double reach,
                                         const std::vector<int>& among) const {
  struct Candidate {
    NearPoint near;
    const Triangle* triangle;
  };
  std::vector<Candidate> candidates;
  for (const int index : among) {
    const Triangle& triangle = triangles_[index];
    const double limit = triangle.radius + reach;
    if ((triangle.middle - centre).squaredNorm() > limit * limit) continue;
    const Vector3d point = ClosestOnTriangle(centre, triangle.corners);
    const double distance = (centre - point).norm();
    if (distance > reach || distance < kSamePoint) continue;
    const auto& [a, b, c] = triangle.corners;
    if ((b - a).cross(c - a).dot(centre - a) <= 0) continue;
    candidates.push_back({{point, (centre - point) / distance, distance}, &triangle});
  }
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return c.near.distance; });
  std::vector<NearPoint> found;
  for (const Candidate& candidate : candidates) {
    const Vector3d& point = candidate.near.point;
    const bool known = std::ranges::any_of(found, [&](const NearPoint& other) {
      return (other.point - point).squaredNorm() < kSamePoint * kSamePoint;
    });
    // A border point of a triangle is not a minimum if the adjacent triangle is nearer.
    const bool minimum = std::ranges::none_of(candidates, [&](const Candidate& other) {
      return other.near.distance < candidate.near.distance - kSamePoint &&
             (ClosestOnTriangle(point, other.triangle->corners) - point).norm() < kSamePoint;
    });
    if (!known && minimum) found.push_back(candidate.near);
  }
  return found;
}

}  // namespace regrasp::collision
