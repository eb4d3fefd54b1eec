#include "planner/object/wrench_frame.h"

#include <Eigen/Geometry>

namespace regrasp::object {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Zeroth, first and second moments about the base point of the sums.
struct Moments {
  double zeroth = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
};

Matrix3d Square(const Vector3d& v) { return v * v.transpose(); }

MassProperties AboutCentroid(const Moments& moments, const Vector3d& from) {
  MassProperties mass;
  mass.volume = moments.zeroth;
  if (!(mass.volume > 0)) return mass;
  const Vector3d centroid = moments.first / mass.volume;
  const Matrix3d second = moments.second - mass.volume * Square(centroid);
  mass.centroid = from + centroid;
  mass.inertia = second.trace() * Matrix3d::Identity() - second;
  return mass;
}

}  // namespace

MassProperties ComputeMassProperties(const std::vector<Vector3d>& vertices,
                                     const std::vector<std::array<int, 3>>& triangles) {
  // The base point is a vertex and not the origin, because a solid far away would lose precision.
  const Vector3d from = vertices[triangles.front()[0]];
  Moments moments;
  for (const auto& [i, j, k] : triangles) {
    const Vector3d a = vertices[i] - from, b = vertices[j] - from, c = vertices[k] - from;
    const double volume = a.dot(b.cross(c)) / 6;
    const Vector3d sum = a + b + c;
    moments.zeroth += volume;
    moments.first += volume / 4 * sum;
    moments.second += volume / 20 * (Square(sum) + Square(a) + Square(b) + Square(c));
  }
  return AboutCentroid(moments, from);
}

MassProperties ComputeMassProperties(const std::vector<std::vector<Vector2d>>& rings) {
  const Vector2d from = rings.front().front();
  Moments moments;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d p = ring[i] - from, q = ring[(i + 1) % ring.size()] - from;
      const Vector3d a(p.x(), p.y(), 0), b(q.x(), q.y(), 0);
      const double cross = a.cross(b).z();
      moments.zeroth += cross / 2;
      moments.first += cross / 6 * (a + b);
      moments.second += cross / 24 * (Square(a + b) + Square(a) + Square(b));
    }
  }
  return AboutCentroid(moments, {from.x(), from.y(), 0});
}

}  // namespace regrasp::object
