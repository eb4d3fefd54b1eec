#include "planner/sets/polyhedron/union_volume.h"

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

UnionVolume::Shape::Shape(const FacePart& part)
    : origin(part.origin), u(part.u), v(part.v), normal(part.normal) {
  const std::size_t n = part.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    Side side;
    side.from = part.outline[i];
    const Vector2d to_next = part.outline[(i + 1) % n] - side.from;
    side.length = to_next.norm();
    side.along = to_next / side.length;
    side.outward = {side.along.y(), -side.along.x()};
    sides.push_back(side);
  }
}

UnionVolume::Shape::Shape(const FacePart& part, const Vector3d& contact)
    : origin(contact), u(part.u), v(part.v), normal(part.normal) {}

Cut UnionVolume::CutAt(const Vector3d& x) const {
  const Vector3d from_origin = x - shape_->origin;
  const Vector2d foot(shape_->u.dot(from_origin), shape_->v.dot(from_origin));
  Cut cut;
  cut.gradient = -sin_ * shape_->normal;
  // Outside a convex part the nearest point is on the first side, in their order, that the foot is
  // beyond and beside, or else the corner where the foot is past one side and before the next.
  Vector2d away = Vector2d::Zero();
  Vector2d nearest = Vector2d::Zero();
  double nearest_square = 0;
  bool outside = shape_->sides.empty() && !foot.isZero(0);
  if (outside) away = foot;
  for (const Shape::Side& side : shape_->sides) {
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
    cut.gradient += cos_ * (away.x() * shape_->u + away.y() * shape_->v);
    cut.offset = -cos_ * away.dot(nearest);
  }
  cut.offset -= cut.gradient.dot(shape_->origin);
  return cut;
}

}  // namespace regrasp::polyhedron
