#include "sim/actuation/penetration.h"

#include <cmath>
#include <numbers>

namespace regrasp::sim {
namespace {

using collision::ConvexShape;
using Eigen::Vector3d;

/// Resolution of Depth, metres.
constexpr double kDepthStep = 5e-5;

/// Return the directions from the centre of a cube to its faces, edges and corners.
const std::vector<Vector3d>& SpreadDirections() {
  static const std::vector<Vector3d> directions = [] {
    std::vector<Vector3d> made;
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x != 0 || y != 0 || z != 0) made.push_back(Vector3d(x, y, z).normalized());
        }
      }
    }
    return made;
  }();
  return directions;
}

ConvexShape Translated(const ConvexShape& shape, const Vector3d& way) {
  return collision::Moved(Eigen::Isometry3d(Eigen::Translation3d(way)), shape);
}

/// Return the solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983).
double SolidAngle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(a.dot(b.cross(c)), below);
}

}  // namespace

Penetration::Penetration(const object::Polyhedron& solid, double scale) : surface_(solid, scale) {
  for (const auto& [a, b, c] : solid.triangles()) {
    triangles_.push_back(
        {scale * solid.vertices()[a], scale * solid.vertices()[b], scale * solid.vertices()[c]});
  }
  for (const Vector3d& vertex : solid.vertices()) box_.extend(scale * vertex);
}

bool Penetration::Contains(const Vector3d& point) const {
  if (!box_.contains(point)) return false;
  double angle = 0;
  for (const auto& [a, b, c] : triangles_) angle += SolidAngle(a - point, b - point, c - point);
  return std::abs(angle) > 2 * std::numbers::pi;
}

bool Penetration::IsOutAfter(const ConvexShape& shape, const Vector3d& way) const {
  const ConvexShape moved = Translated(shape, way);
  return surface_.IsApart(moved, 0) && !Contains(moved.points.front());
}

bool Penetration::IsDeeper(const ConvexShape& shape, double depth, const Vector3d& outward) const {
  const bool is_near = outward != Vector3d::Zero();
  if (surface_.IsApart(shape, 0)) {
    // A shape that is entirely inside can also be far from the surface.
    if (is_near || !Contains(shape.points.front())) return false;
  } else if (is_near && surface_.IsApart(Translated(shape, depth * outward), 0)) {
    return false;
  }
  for (const Vector3d& direction : SpreadDirections()) {
    if (IsOutAfter(shape, depth * direction)) return false;
  }
  return true;
}

double Penetration::Depth(const ConvexShape& shape, double most, const Vector3d& outward) const {
  if (!IsDeeper(shape, 0, outward)) return 0;
  double low = 0;
  double high = most;
  while (high - low > kDepthStep) {
    const double middle = (low + high) / 2;
    (IsDeeper(shape, middle, outward) ? low : high) = middle;
  }
  return high;
}

}  // namespace regrasp::sim
