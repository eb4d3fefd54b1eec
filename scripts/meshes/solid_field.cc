#include "solid_field.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace regrasp_meshes {

namespace {

/// Step of finite differences, m, for solids of 0.1 m and a rounding error of 1e-17.
constexpr double kDifference = 1e-6;
/// Tolerance on the surface, m: a thousandth of the resolution of the files.
constexpr double kOnSurface = 1e-12;
constexpr int kMaxSteps = 100;

Point Gradient(const Field& field, const Point& p) {
  Point gradient;
  for (int i = 0; i < 3; ++i) {
    const Point step = kDifference * Point::Unit(i);
    gradient[i] = (field(p + step) - field(p - step)) / (2 * kDifference);
  }
  return gradient;
}

}  // namespace

double Ellipsoid(const Point& p, const Point& centre, const Point& semi_axes) {
  const Point scaled = (p - centre).cwiseQuotient(semi_axes);
  const double length = scaled.norm();
  const double slope = scaled.cwiseQuotient(semi_axes).norm();
  if (slope == 0) return -semi_axes.minCoeff();
  return length * (length - 1) / slope;
}

double SweptBall(const Point& p, const Point& a, const Point& b, double at_a, double at_b) {
  const Point ab = b - a;
  const double share = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (p - a - share * ab).norm() - (at_a + share * (at_b - at_a));
}

double Ring(const Point& p, double radius, double tube) {
  return std::hypot(std::hypot(p.x(), p.y()) - radius, p.z()) - tube;
}

double RoundedCylinder(const Point& p, double radius, double low, double high, double rounding) {
  const double across = std::hypot(p.x(), p.y()) - (radius - rounding);
  const double along = std::abs(p.z() - (low + high) / 2) - ((high - low) / 2 - rounding);
  return std::min(std::max(across, along), 0.0) +
         std::hypot(std::max(across, 0.0), std::max(along, 0.0)) - rounding;
}

double Join(double a, double b, double blend) {
  const double near = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - near * near * near / (6 * blend * blend);
}

double Cut(double a, double b, double blend) { return -Join(-a, b, blend); }

Point ProjectToSurface(const Field& field, const Point& p) {
  Point q = p;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double value = field(q);
    const Point gradient = Gradient(field, q);
    q -= value / gradient.squaredNorm() * gradient;
    if (std::abs(value) <= kOnSurface) return q;
  }
  throw std::runtime_error("no way to the surface");
}

}  // namespace regrasp_meshes
