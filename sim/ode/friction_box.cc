#include "sim/ode/friction_box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// A friction force below this share of the normal one has no direction to speak of.
constexpr double kNoDirection = 1e-9;

/// A box holds a force back that comes this near to its side, relatively.
constexpr double kAtSide = 1e-6;

double NormalPart(const Vector3d& normal, const Vector3d& force) {
  return std::max(force.dot(normal), 0.0);
}

Vector3d Tangential(const Vector3d& normal, const Vector3d& force) {
  return force - force.dot(normal) * normal;
}

}  // namespace

FrictionBox BoxInCircle(const Vector3d& normal, const Vector3d& force, double mu) {
  const double pressing = NormalPart(normal, force);
  const double limit = mu * pressing;
  const Vector3d friction = Tangential(normal, force);
  const double size = friction.norm();
  FrictionBox box;
  box.direction =
      size > kNoDirection * pressing ? Vector3d(friction / size) : normal.unitOrthogonal();
  box.along = std::clamp((size + limit) / 2, std::sqrt(0.5) * limit, kLongest * limit);
  box.across = std::sqrt(limit * limit - box.along * box.along);
  return box;
}

FrictionBox BoxInPlane(const Vector3d& normal, const Vector3d& force, double mu) {
  return {Vector3d::UnitZ().cross(normal).normalized(), mu * NormalPart(normal, force), 0};
}

bool KeepsCone(const Vector3d& normal, const FrictionBox& box, const Vector3d& force, double mu,
               double slack) {
  const double limit = mu * NormalPart(normal, force);
  const double allowed = kConeTolerance * limit + slack;
  const Vector3d friction = Tangential(normal, force);
  if (friction.norm() > limit + allowed) return false;
  const double along = std::abs(friction.dot(box.direction));
  const double across = std::abs(friction.dot(normal.cross(box.direction)));
  const bool held = along >= (1 - kAtSide) * box.along ||
                    (box.across > 0 && across >= (1 - kAtSide) * box.across);
  return !held || friction.norm() >= limit - allowed;
}

}  // namespace regrasp::sim
