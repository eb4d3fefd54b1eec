#include "planner/sets/polyhedron/min_max.h"

#include <cmath>
#include <limits>

namespace regrasp::polyhedron {

using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

/// Values this small, over the reach, may be rounding.
constexpr double kRounding = 1e-14;

/// A minimum is found when it is known to this share of its value.
constexpr double kRelativeGap = 0.01;

/// Solving four convex functions takes about ten pivots; far more happen only where roundings turn
/// in circles.
constexpr lp::Limits kLimits = {.pivots = 100, .refactor_after = 24};

}  // namespace

MinMax::MinMax(const Vector3d& centre, double reach)
    : centre_(centre), reach_(reach), rounding_(kRounding * reach) {
  // A regular tetrahedron about the ball of the reach: its faces are cuts of value 0.
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

/// Whether the cuts at hand prove that their largest one is positive everywhere within reach: a
/// convex combination of them, computed anew, is a positive constant up to a small slope.
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
    // Nothing is decided where the gap is small beside a value that is smaller still.
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
