#include "sim/ode/ode_world.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <mutex>
#include <string>

#include "sim/scene/engine.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Friction force over the normal force below which its direction is undefined.
constexpr double kNoDirection = 1e-9;

/// Relative distance to a side at which the box limits a force.
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

namespace {

using Eigen::Vector2d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Return the point of a convex region nearest to `q`, which is `q` itself if inside.
Vector2d NearestInRegion(const std::vector<Vector2d>& outline, const Vector2d& q) {
  Vector2d nearest = q;
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d edge = outline[(i + 1) % outline.size()] - a;
    inside = inside && Cross(edge, q - a) >= 0;
    const double along = std::clamp(edge.dot(q - a) / edge.squaredNorm(), 0.0, 1.0);
    const Vector2d point = a + along * edge;
    const double distance = (q - point).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = point;
  }
  return inside ? q : nearest;
}

}  // namespace

PatchPrism MakePrism(const ContactPatch& patch, const Vector3d& inward, double thickness) {
  PatchPrism prism;
  prism.origin = patch.outline[0];
  prism.thickness = thickness;
  const Vector3d outward = -inward;
  const Vector3d edge = patch.outline[1] - patch.outline[0];
  const Vector3d u = (edge - edge.dot(outward) * outward).normalized();
  prism.axes << u, outward.cross(u), outward;
  for (const Vector3d& corner : patch.outline) {
    prism.outline.emplace_back(prism.axes.leftCols<2>().transpose() * (corner - prism.origin));
  }
  return prism;
}

std::optional<PatchTouch> TouchPatch(const PatchPrism& prism, const Vector3d& centre,
                                     double radius) {
  const Vector3d local = prism.axes.transpose() * (centre - prism.origin);
  const double height = local.z();
  if (height >= radius || height < -prism.thickness) return std::nullopt;
  const Vector2d nearest = NearestInRegion(prism.outline, local.head<2>());
  const bool above = nearest == local.head<2>();
  const double level = above ? 0 : std::min(height, 0.0);
  const Vector3d point(nearest.x(), nearest.y(), level);
  const Vector3d away = above ? Vector3d(0, 0, height) : Vector3d(local - point);
  const double distance = above ? height : away.norm();
  if (distance >= radius || (!above && distance == 0)) return std::nullopt;
  const Vector3d normal = above ? Vector3d(0, 0, -1) : Vector3d(-away / distance);
  return PatchTouch{prism.origin + prism.axes * point, prism.axes * normal, radius - distance};
}

namespace {

/// Set if ODE reports a problem during a step of this thread: its solver of complementarity
/// problems found a pivot that is not positive.
thread_local bool complained = false;

void TakeMessage(int /*number*/, const char* /*format*/, va_list /*values*/) { complained = true; }

/// Throw instead of ODE's end of the process.
[[noreturn]] void ThrowError(int /*number*/, const char* format, va_list values) {
  std::array<char, 500> text{};
  (void)std::vsnprintf(text.data(), text.size(), format, values);
  throw UnstableError(std::string("engine error: ") + text.data());
}

}  // namespace

OdeWorld MakeOdeWorld() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(TakeMessage);
    dSetErrorHandler(ThrowError);
    dSetDebugHandler(ThrowError);
  });
  OdeWorld made{OdeThreadingPtr(dThreadingAllocateSelfThreadedImplementation()),
                OdeWorldPtr(dWorldCreate())};
  dWorldSetStepThreadingImplementation(
      made.get(), dThreadingImplementationGetFunctions(made.threading.get()), made.threading.get());
  return made;
}

bool StepOde(dWorldID world, double timestep) {
  complained = false;
  dWorldStep(world, timestep);
  return !complained;
}

void AppendVector(const Vector3d& v, std::vector<double>& values) {
  values.insert(values.end(), v.data(), v.data() + 3);
}

Vector3d TakeVector(const double*& values) {
  const Vector3d v(values[0], values[1], values[2]);
  values += 3;
  return v;
}

}  // namespace regrasp::sim
