#include "tests/planner/sets/polygon/direct_conditions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace regrasp::polygon {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// Half side of the square from which cones are clipped, divided by the polygon's size.
constexpr double kSquare = 1e4;

Vector2d Planar(const Eigen::Vector3d& v) { return v.head<2>(); }
double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
double Angle(const Vector2d& v) { return std::atan2(v.y(), v.x()); }
double Between(const Vector2d& a, const Vector2d& b) {
  return std::abs(std::atan2(Cross(a, b), a.dot(b)));
}
double Wrap(double angle) { return std::remainder(angle, 2 * kPi); }

/// Compute π minus the largest gap between adjacent normals.
double SpanningExcess(std::span<const grasp::Contact> contacts) {
  std::array<double, 3> angles;
  for (int k = 0; k < 3; ++k) angles[k] = Angle(Planar(contacts[k].n));
  std::sort(angles.begin(), angles.end());
  return kPi -
         std::max({angles[1] - angles[0], angles[2] - angles[1], 2 * kPi + angles[0] - angles[2]});
}

/// Clip a convex polygon at the line through p along w: keep its left side and up to `by` on the
/// right.
std::vector<Vector2d> Clip(const std::vector<Vector2d>& polygon, const Vector2d& p,
                           const Vector2d& w, double by) {
  std::vector<Vector2d> clipped;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d& a = polygon[k];
    const Vector2d& b = polygon[(k + 1) % n];
    const double fa = Cross(w, a - p) + by;
    const double fb = Cross(w, b - p) + by;
    if (fa > 0) clipped.push_back(a);
    if ((fa > 0) != (fb > 0)) clipped.push_back(a + fa / (fa - fb) * (b - a));
  }
  return clipped;
}

/// Return whether the cones on the given sides have a common interior if every border is moved
/// outward by `by`.
bool ConesMeet(std::span<const grasp::Contact> contacts, int sides, double friction_angle,
               double size, double by) {
  const Vector2d middle = Planar(contacts[0].p);
  const double half = kSquare * size;
  std::vector<Vector2d> rest = {middle + Vector2d(-half, -half), middle + Vector2d(half, -half),
                                middle + Vector2d(half, half), middle + Vector2d(-half, half)};
  for (int k = 0; k < 3 && !rest.empty(); ++k) {
    const double side = (sides >> k & 1) != 0 ? -1 : 1;
    const Vector2d n = side * Planar(contacts[k].n);
    const Vector2d p = Planar(contacts[k].p);
    rest = Clip(rest, p, Eigen::Rotation2Dd(-friction_angle) * n, by);
    rest = Clip(rest, p, -(Eigen::Rotation2Dd(friction_angle) * n), by);
  }
  return !rest.empty();
}

/// Return the directions, relative to −n_a, in −C(n_a), C(n_b) and C(n_c), widened by `by` at both
/// ends.
std::optional<std::array<double, 2>> CommonDirections(const grasp::Contact& a,
                                                      const grasp::Contact& b,
                                                      const grasp::Contact& c,
                                                      double friction_angle, double by) {
  const double zero = Angle(-Planar(a.n));
  const double beta = Wrap(Angle(Planar(b.n)) - zero);
  const double gamma = Wrap(Angle(Planar(c.n)) - zero);
  const double low = std::max({0.0, beta, gamma}) - friction_angle - by;
  const double high = std::min({0.0, beta, gamma}) + friction_angle + by;
  if (low >= high) return std::nullopt;
  return std::array{low, high};
}

/// Return the largest distance of two outer lines on different sides from the centre's line; −1 if
/// there are none.
double ParallelMargin(const grasp::Contact& a, const grasp::Contact& b, const grasp::Contact& c,
                      double friction_angle, double by) {
  const auto directions = CommonDirections(a, b, c, friction_angle, by);
  if (!directions) return -1;
  const double zero = Angle(-Planar(a.n));
  const Vector2d to_b = Planar(b.p - a.p);
  const Vector2d to_c = Planar(c.p - a.p);
  // The side of a contact changes only at the direction to it or from it.
  std::vector<double> ends = {(*directions)[0], (*directions)[1]};
  for (const Vector2d& v : {to_b, to_c}) {
    for (const Vector2d& w : {v, Vector2d(-v)}) {
      const double angle = Wrap(Angle(w) - zero);
      if (angle > (*directions)[0] && angle < (*directions)[1]) ends.push_back(angle);
    }
  }
  std::sort(ends.begin(), ends.end());
  double best = -1;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double angle = zero + (ends[k] + ends[k + 1]) / 2;
    const Vector2d w(std::cos(angle), std::sin(angle));
    const double fb = Cross(w, to_b);
    const double fc = Cross(w, to_c);
    if (fb * fc < 0) best = std::max(best, std::min(std::abs(fb), std::abs(fc)));
  }
  return best;
}

}  // namespace

double ConcurrentFrictionAngle(std::span<const grasp::Contact> contacts, double friction_angle,
                               planning::Spanning spanning) {
  const double excess = SpanningExcess(contacts);
  if (spanning == planning::Spanning::kUniform)
    return excess > 2 * friction_angle ? friction_angle : 0;
  return std::max(0.0, std::min(friction_angle, excess / 2));
}

std::vector<DirectKind> KindsOfTwo(std::span<const grasp::Contact> contacts,
                                   double friction_angle) {
  const Vector2d v = Planar(contacts[1].p - contacts[0].p);
  const Vector2d na = Planar(contacts[0].n);
  const Vector2d nb = Planar(contacts[1].n);
  std::vector<DirectKind> kinds;
  for (const int part : {0, 1}) {
    const Vector2d to_b = part == 0 ? v : Vector2d(-v);
    const double margin = friction_angle - std::max(Between(na, to_b), Between(nb, -to_b));
    if (margin > -kDirectMargin) {
      kinds.push_back({GraspType::kTwoFinger, part, margin > kDirectMargin});
    }
  }
  return kinds;
}

std::vector<DirectKind> KindsOfThree(std::span<const grasp::Contact> contacts,
                                     double friction_angle, planning::Spanning spanning,
                                     double size) {
  std::vector<DirectKind> kinds;
  const double margin = kDirectMargin * size;
  const bool spans_clearly =
      spanning == planning::Spanning::kAdaptive ||
      std::abs(SpanningExcess(contacts) - 2 * friction_angle) > kDirectMargin;
  const double phi = ConcurrentFrictionAngle(contacts, friction_angle, spanning);
  for (int sides = 0; sides < 8 && phi > 0; ++sides) {
    if (!ConesMeet(contacts, sides, phi, size, margin)) continue;
    const bool certain = spans_clearly && ConesMeet(contacts, sides, phi, size, -margin);
    kinds.push_back({GraspType::kConcurrent, sides, certain});
  }
  for (int centre = 0; centre < 3; ++centre) {
    const grasp::Contact& a = contacts[centre];
    const grasp::Contact& b = contacts[(centre + 1) % 3];
    const grasp::Contact& c = contacts[(centre + 2) % 3];
    if (ParallelMargin(a, b, c, friction_angle, kDirectMargin) < 0) continue;
    const bool certain = ParallelMargin(a, b, c, friction_angle, -kDirectMargin) > margin;
    kinds.push_back({GraspType::kParallel, centre, certain});
  }
  return kinds;
}

}  // namespace regrasp::polygon
