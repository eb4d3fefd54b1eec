#include "sim/actuation/penetration.h"

#include <Eigen/Geometry>
#include <vector>

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;

/// Resolution of DepthIn, metres.
constexpr double kDepthStep = 5e-5;

/// The directions from the middle of a cube to its faces, edges and corners.
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

bool IsOutAfter(const collision::SurfaceTree& surface, const collision::ConvexShape& shape,
                const Vector3d& way) {
  return surface.IsApart(collision::Moved(Eigen::Isometry3d(Eigen::Translation3d(way)), shape), 0);
}

}  // namespace

bool IsDeeperThan(const collision::SurfaceTree& surface, const collision::ConvexShape& shape,
                  double depth, const Vector3d& outward) {
  if (surface.IsApart(shape, 0)) return false;
  if (outward != Vector3d::Zero() && IsOutAfter(surface, shape, depth * outward)) return false;
  for (const Vector3d& direction : SpreadDirections()) {
    if (IsOutAfter(surface, shape, depth * direction)) return false;
  }
  return true;
}

double DepthIn(const collision::SurfaceTree& surface, const collision::ConvexShape& shape,
               double most, const Vector3d& outward) {
  if (surface.IsApart(shape, 0)) return 0;
  double low = 0;
  double high = most;
  while (high - low > kDepthStep) {
    const double middle = (low + high) / 2;
    (IsDeeperThan(surface, shape, middle, outward) ? low : high) = middle;
  }
  return high;
}

}  // namespace regrasp::sim
