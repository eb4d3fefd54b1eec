#include "sim/hand/gap.h"

#include <algorithm>
#include <cmath>

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// The descent comes near slowly where faces are parallel; what is not shown by then is not shown.
constexpr int kMostSteps = 400;

const Vector3d& FarthestAlong(const std::vector<Vector3d>& points, const Vector3d& direction) {
  return *std::ranges::max_element(
      points, {}, [&](const Vector3d& point) { return point.dot(direction); });
}

}  // namespace

Solid MakeSolid(std::vector<Vector3d> points, double radius) {
  Solid solid{std::move(points), radius, Vector3d::Zero(), 0};
  for (const Vector3d& point : solid.points) solid.centre += point;
  solid.centre /= static_cast<double>(solid.points.size());
  for (const Vector3d& point : solid.points) {
    solid.reach = std::max(solid.reach, (point - solid.centre).norm());
  }
  solid.reach += radius;
  return solid;
}

bool HaveGap(const Solid& a, const Solid& b, double gap) {
  if ((a.centre - b.centre).norm() - a.reach - b.reach > gap) return true;
  const double needed = gap + a.radius + b.radius;
  if (needed < 0) return true;
  Vector3d between = a.points.front() - b.points.front();
  for (int step = 0; step < kMostSteps; ++step) {
    const double length = between.norm();
    if (length <= needed) return false;
    // All of the difference of the hulls is beyond this plane.
    const Vector3d support = FarthestAlong(a.points, -between) - FarthestAlong(b.points, between);
    if (support.dot(between) > needed * length) return true;
    const Vector3d along = support - between;
    const double square = along.squaredNorm();
    if (square == 0) return false;
    between += std::clamp(-between.dot(along) / square, 0.0, 1.0) * along;
  }
  return false;
}

}  // namespace regrasp::sim
