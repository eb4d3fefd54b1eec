#include "planner/collision/hull_distance.h"

#include <algorithm>
#include <cmath>

#include "planner/collision/nearest_points.h"

namespace regrasp::collision {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

constexpr double kConverged = 1e-9;  // relative to the distance
constexpr int kMostIterations = 100;
/// Rounding error of differences and products, relative to the size of the points.
constexpr double kRounding = 1e-14;

double SizeOf(Points points) {
  double size = 0;
  for (const Vector3d& point : points) size = std::max(size, point.lpNorm<1>());
  return size;
}

}  // namespace

HullBounds HullDistance(Points a, Points b, std::optional<double> decided) {
  const double slack = kRounding * (SizeOf(a) + SizeOf(b));
  HullBounds bounds;
  HullSimplex simplex;
  // Search for the point of the difference a − b nearest to the origin.
  Vector3d nearest = a.front() - b.front();
  simplex.points[0] = nearest;
  simplex.size = 1;
  bounds.upper = nearest.norm();
  for (int i = 0; i < kMostIterations; ++i) {
    if (bounds.upper <= slack) return {{0, bounds.upper}};
    const Vector3d support = Farthest(a, -nearest) - Farthest(b, nearest);
    const double lower = support.dot(nearest) / bounds.upper - slack;
    if (lower > bounds.lower) {
      bounds.lower = lower;
      bounds.direction = nearest;
    }
    if (decided && (bounds.lower > *decided || bounds.upper <= *decided)) return bounds;
    if (bounds.upper - bounds.lower <= kConverged * bounds.upper + slack) return bounds;
    simplex.points[simplex.size++] = support;
    nearest = ReduceToNearest(simplex);
    if (simplex.size == 4) return {};
    const double upper = nearest.norm();
    // The remaining difference is rounding error.
    if (upper >= bounds.upper) return bounds;
    bounds.upper = upper;
  }
  return bounds;
}

bool AreApartAlong(Points a, Points b, const Vector3d& direction, double distance) {
  const double length = direction.norm();
  if (!(length > 0)) return false;
  const double slack = kRounding * (SizeOf(a) + SizeOf(b));
  const Vector3d gap = Farthest(a, -direction) - Farthest(b, direction);
  return gap.dot(direction) / length - slack > distance;
}

}  // namespace regrasp::collision
