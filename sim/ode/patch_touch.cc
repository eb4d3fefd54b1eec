#include "sim/ode/patch_touch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace regrasp::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The point of a convex region that is nearest to `q`: `q` itself inside.
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

}  // namespace regrasp::sim
