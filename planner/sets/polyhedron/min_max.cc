#include "planner/sets/polyhedron/min_max.h"

#include <cmath>
#include <limits>

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

using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

/// Bound on rounding of values, divided by the reach.
constexpr double kRounding = 1e-14;

/// Relative accuracy at which a minimum counts as found.
constexpr double kRelativeGap = 0.01;

/// Four convex functions take about ten pivots. Far more occur only if rounding causes cycles.
constexpr lp::Limits kLimits = {.pivots = 100, .refactor_after = 24};

}  // namespace

MinMax::MinMax(const Vector3d& centre, double reach)
    : centre_(centre), reach_(reach), rounding_(kRounding * reach) {
  // The faces of a regular tetrahedron about the ball of radius `reach` are cuts of value 0.
  const double s = std::sqrt(1.0 / 3);
  Resume({{{Vector3d(s, s, s), -reach_},
           {Vector3d(s, -s, -s), -reach_},
           {Vector3d(-s, s, -s), -reach_},
           {Vector3d(-s, -s, s), -reach_}}});
  first_ = program_;
}

void MinMax::Resume(const Basis& basis) {
  program_.StartFromBasis({{{basis[0]}, {basis[1]}, {basis[2]}, {basis[3]}}}, Vector4d::Unit(3));
}

MinMax::Basis MinMax::basis() const {
  Basis basis;
  for (int k = 0; k < kRows; ++k) basis[k] = program_.column(k)->cut;
  return basis;
}

/// Return whether the current cuts prove that their maximum is positive everywhere within reach. A
/// recomputed convex combination of them must be a positive constant up to a small slope.
bool MinMax::IsSeparated() const {
  Vector3d slope = Vector3d::Zero();
  double constant = 0;
  for (int k = 0; k < kRows; ++k) {
    const double weight = std::max(program_.weights()[k], 0.0);
    slope += weight * program_.column(k)->cut.gradient;
    constant += weight * program_.column(k)->cut.offset;
  }
  return constant - slope.norm() * reach_ > rounding_;
}

template <class Oracle>
MinMaxResult MinMax::SolveWith(const Oracle& largest_cut, Until until) {
  MinMaxResult best;
  best.value = std::numeric_limits<double>::infinity();
  const auto price = [&](const Vector4d& dual, Column& column) {
    const Vector3d point = dual.head<3>();
    const double bound = -dual[3];
    if (bound > rounding_ && IsSeparated()) {
      best.overlap = Overlap::kNone;
      return false;
    }
    Cut& largest = column.cut;
    largest = largest_cut(centre_ + point);
    largest.offset += largest.gradient.dot(centre_);
    const double value = largest.At(point);
    if (value < best.value) {
      best.value = value;
      best.point = centre_ + point;
      if (value < -rounding_) best.overlap = Overlap::kSome;
    }
    if (until == Until::kSign && best.overlap == Overlap::kSome) return false;
    // If the value is close to 0, a small gap decides nothing.
    const bool near = best.value - bound <= kRelativeGap * std::abs(best.value);
    if ((near && best.overlap == Overlap::kSome) || value - bound <= rounding_) return false;
    return true;
  };
  program_.Run(price, kLimits);
  return best;
}

MinMaxResult MinMax::Solve(std::span<const UnionVolume> volumes, Until until) {
  return SolveWith([&](const Vector3d& point) { return LargestCutAt(volumes, point); }, until);
}

MinMaxResult MinMax::Solve(const LargestCut& largest_cut, Until until) {
  return SolveWith(largest_cut, until);
}

}  // namespace regrasp::polyhedron
