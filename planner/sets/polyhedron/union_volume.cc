#include "planner/sets/polyhedron/union_volume.h"

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

Cut UnionVolume::CutAt(const Vector3d& x) const {
  const Vector2d foot = part_->FootOf(x);
  Cut cut;
  cut.gradient = -sin_ * part_->normal;
  // If the foot is outside the part, the nearest point is on the first side whose outer strip
  // contains the foot. If there is no such side, it is the nearest corner.
  Vector2d away = Vector2d::Zero();
  Vector2d nearest = Vector2d::Zero();
  double nearest_square = 0;
  bool outside = part_->sides.empty() && !foot.isZero(0);
  if (outside) away = foot;
  for (const FacePart::Side& side : part_->sides) {
    const Vector2d from_side = foot - side.from;
    const double beyond = side.outward.dot(from_side);
    if (beyond <= 0) continue;
    const double along = side.along.dot(from_side);
    if (along >= 0 && along <= side.length) {
      outside = true;
      away = side.outward;
      nearest = side.from;
      break;
    }
    const Vector2d corner = along < 0 ? side.from : Vector2d(side.from + side.length * side.along);
    const double square = (foot - corner).squaredNorm();
    if (outside && square >= nearest_square) continue;
    outside = true;
    nearest_square = square;
    nearest = corner;
    away = foot - corner;
  }
  if (outside) {
    away.normalize();
    cut.gradient += cos_ * (away.x() * part_->u + away.y() * part_->v);
    cut.offset = -cos_ * away.dot(nearest);
  }
  cut.offset -= cut.gradient.dot(part_->origin);
  return cut;
}

}  // namespace regrasp::polyhedron
