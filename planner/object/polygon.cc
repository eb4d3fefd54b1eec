#include "planner/object/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp {
using Eigen::Vector2d;
using Eigen::Vector3d;

Polygon Polygon::FromRings(std::vector<std::vector<Vector2d>> rings, const std::string& name) {
  if (rings.empty()) throw InputError(name + ": no rings");
  double area = 0;
  Vector2d first = Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  const Vector2d o = rings[0].at(0);
  double diameter = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    auto& ring = rings[r];
    if (ring.size() < 3)
      throw InputError(name + ": ring " + std::to_string(r) + ": fewer than three points");
    const auto cross = [](const Vector2d& a, const Vector2d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      twice += cross(ring[i] - o, ring[(i + 1) % ring.size()] - o);
      for (const auto& q : rings[0]) diameter = std::max(diameter, (q - ring[i]).norm());
    }
    if ((twice > 0) != (r == 0)) std::ranges::reverse(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d a = ring[i] - o, b = ring[(i + 1) % ring.size()] - o;
      const double c = cross(a, b);
      area += c / 2;
      first += c / 6 * (a + b);
      second += c / 24 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
    }
  }
  MassProperties mass;
  mass.volume = area;
  const Vector2d centroid = first / area;
  second -= area * centroid * centroid.transpose();
  mass.centroid.head<2>() = centroid + o;
  mass.inertia(0, 0) = second(1, 1);
  mass.inertia(1, 1) = second(0, 0);
  mass.inertia(0, 1) = mass.inertia(1, 0) = -second(0, 1);
  mass.inertia(2, 2) = second.trace();
  return Polygon(std::move(rings), diameter, mass);
}

Polygon Polygon::FromWkt(std::string_view, const std::string& name) {
  throw InputError(name + ": WKT");
}

Polygon::Polygon(std::vector<std::vector<Vector2d>> rings, double diameter, MassProperties mass)
    : Object(diameter, std::move(mass)), rings_(std::move(rings)) {
  for (const auto& ring : rings_) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges_.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
}

std::pair<Vector3d, Vector3d> Polygon::edge(int face) const {
  const auto& [a, b] = edges_[face];
  return {Vector3d(a.x(), a.y(), 0), Vector3d(b.x(), b.y(), 0)};
}
Vector3d Polygon::inward_normal(int face) const {
  const auto [a, b] = edge(face);
  const Vector3d d = (b - a).normalized();
  return {-d.y(), d.x(), 0};
}
double Polygon::face_measure(int face) const {
  return (edges_[face].second - edges_[face].first).norm();
}
Vector3d Polygon::ClosestPoint(int face, const Vector3d& point) const {
  const auto [a, b] = edge(face);
  const Vector3d d = b - a;
  return a + std::clamp((point - a).dot(d) / d.squaredNorm(), 0.0, 1.0) * d;
}
std::vector<int> Polygon::FacesNear(const Vector3d& point, double tolerance) const {
  std::vector<std::pair<double, int>> near;
  for (int f = 0; f < face_count(); ++f) {
    const double distance = (ClosestPoint(f, point) - point).norm();
    if (distance <= tolerance) near.push_back({distance, f});
  }
  std::ranges::sort(near);
  std::vector<int> result;
  for (const auto& [distance, f] : near) result.push_back(f);
  return result;
}
double Polygon::DistanceToBorder(int face, const Vector3d& point) const {
  const auto [a, b] = edge(face);
  return std::min((point - a).norm(), (point - b).norm());
}
bool Polygon::ContainsSegment(int face, const Vector3d& a, const Vector3d& b,
                              double tolerance) const {
  return (ClosestPoint(face, a) - a).norm() <= tolerance &&
         (ClosestPoint(face, b) - b).norm() <= tolerance;
}
}  // namespace regrasp
