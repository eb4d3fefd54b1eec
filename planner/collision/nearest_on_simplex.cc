#include "planner/collision/nearest_on_simplex.h"

#include <Eigen/Geometry>
#include <limits>

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;

/// Of a face of a simplex that was tried: its nearest point, and the corners it needs.
struct Nearest {
  Vector3d point = Vector3d::Zero();
  Simplex needed;
  double square = std::numeric_limits<double>::infinity();
};

void TakeIfNearer(const Nearest& other, Nearest& best) {
  if (other.square < best.square) best = other;
}

Nearest NearestOfPoint(const Vector3d& a) {
  Nearest nearest;
  nearest.point = a;
  nearest.needed.points[0] = a;
  nearest.needed.size = 1;
  nearest.square = a.squaredNorm();
  return nearest;
}

Nearest NearestOfSegment(const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double t = -a.dot(along);
  const double length = along.squaredNorm();
  if (t <= 0 || length == 0) return NearestOfPoint(a);
  if (t >= length) return NearestOfPoint(b);
  Nearest nearest;
  nearest.point = a + (t / length) * along;
  nearest.needed.points = {a, b};
  nearest.needed.size = 2;
  nearest.square = nearest.point.squaredNorm();
  return nearest;
}

Nearest NearestOfTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  // Barycentric coordinates of the origin's projection, times `square`.
  const double at_a = b.cross(c).dot(normal);
  const double at_b = c.cross(a).dot(normal);
  const double at_c = a.cross(b).dot(normal);
  if (square > 0 && at_a > 0 && at_b > 0 && at_c > 0) {
    Nearest nearest;
    nearest.point = (a.dot(normal) / square) * normal;
    nearest.needed.points = {a, b, c};
    nearest.needed.size = 3;
    nearest.square = nearest.point.squaredNorm();
    return nearest;
  }
  Nearest best = NearestOfSegment(a, b);
  TakeIfNearer(NearestOfSegment(b, c), best);
  TakeIfNearer(NearestOfSegment(c, a), best);
  return best;
}

/// Whether the origin and `d` are on the same side of the plane of a, b and c, or one is on it.
bool IsOnSideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d normal = (b - a).cross(c - a);
  return normal.dot(-a) * normal.dot(d - a) >= 0;
}

Nearest NearestOfTetrahedron(const Simplex& simplex) {
  const auto& [a, b, c, d] = simplex.points;
  const double volume = (b - a).cross(c - a).dot(d - a);
  const bool flat = volume == 0;
  Nearest best;
  bool inside = !flat;
  const auto try_face = [&](const Vector3d& p, const Vector3d& q, const Vector3d& r,
                            const Vector3d& opposite) {
    if (!flat && IsOnSideOf(p, q, r, opposite)) return;
    inside = false;
    TakeIfNearer(NearestOfTriangle(p, q, r), best);
  };
  try_face(a, b, c, d);
  try_face(a, c, d, b);
  try_face(a, b, d, c);
  try_face(b, c, d, a);
  if (!inside) return best;
  best.needed = simplex;
  best.square = 0;
  return best;
}

}  // namespace

Vector3d ReduceToNearest(Simplex& simplex) {
  const auto& points = simplex.points;
  Nearest nearest;
  switch (simplex.size) {
    case 1:
      nearest = NearestOfPoint(points[0]);
      break;
    case 2:
      nearest = NearestOfSegment(points[0], points[1]);
      break;
    case 3:
      nearest = NearestOfTriangle(points[0], points[1], points[2]);
      break;
    default:
      nearest = NearestOfTetrahedron(simplex);
      break;
  }
  simplex = nearest.needed;
  return nearest.point;
}

}  // namespace regrasp::collision
