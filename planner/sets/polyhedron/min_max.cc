#include "planner/sets/polyhedron/min_max.h"

#include <Eigen/LU>
#include <limits>

namespace regrasp {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

/// Values this small, over the reach, may be rounding.
constexpr double kRounding = 1e-14;

/// Entries of a column below this cannot leave the basis: their row would blow up.
constexpr double kLeastPivot = 1e-12;

/// A minimum is found when it is known to this share of its value.
constexpr double kRelativeGap = 0.01;

/// Solving four convex functions takes about ten pivots; far more happen only where roundings turn
/// in circles.
constexpr int kMostPivots = 100;

Vector4d ColumnOf(const Cut& cut) {
  return {cut.gradient.x(), cut.gradient.y(), cut.gradient.z(), 1};
}

}  // namespace

MinMax::MinMax(const Vector3d& centre, double reach)
    : centre_(centre), reach_(reach), rounding_(kRounding * reach) {
  Restart();
}

void MinMax::Restart() {
  // A regular tetrahedron about the ball of the reach: its faces are cuts of value 0.
  const double s = std::sqrt(1.0 / 3);
  const std::array<Vector3d, kRows> directions = {
      Vector3d(s, s, s), {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
  for (int k = 0; k < kRows; ++k) {
    cuts_[k] = {directions[k], -reach_};
    // The inverse of the matrix of these columns.
    inverse_.row(k) << 0.75 * directions[k].transpose(), 0.25;
  }
}

void MinMax::Resume(const Basis& basis) {
  cuts_ = basis;
  Matrix4d columns;
  for (int k = 0; k < kRows; ++k) columns.col(k) = ColumnOf(cuts_[k]);
  inverse_ = columns.inverse();
}

/// (x, −t): where the four cuts are equal, and their value.
Vector4d MinMax::Dual() const {
  Vector4d dual = Vector4d::Zero();
  for (int k = 0; k < kRows; ++k) dual -= cuts_[k].offset * inverse_.row(k).transpose();
  return dual;
}

void MinMax::Enter(const Cut& cut) {
  const Vector4d column = inverse_ * ColumnOf(cut);
  int leaving = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kRows; ++k) {
    if (column[k] <= kLeastPivot) continue;
    const double ratio = inverse_(k, 3) / column[k];
    if (ratio > least || (ratio == least && column[k] <= column[leaving])) continue;
    least = ratio;
    leaving = k;
  }
  const Eigen::RowVector4d row = inverse_.row(leaving) / column[leaving];
  for (int k = 0; k < kRows; ++k) {
    if (k != leaving) inverse_.row(k) -= column[k] * row;
  }
  inverse_.row(leaving) = row;
  cuts_[leaving] = cut;
}

/// Whether the cuts at hand prove that their largest one is positive everywhere within reach: a
/// convex combination of them, computed anew, is a positive constant up to a small slope.
bool MinMax::IsSeparated() const {
  Vector3d slope = Vector3d::Zero();
  double constant = 0;
  for (int k = 0; k < kRows; ++k) {
    const double weight = std::max(inverse_(k, 3), 0.0);
    slope += weight * cuts_[k].gradient;
    constant += weight * cuts_[k].offset;
  }
  return constant - slope.norm() * reach_ > rounding_;
}

template <class Oracle>
MinMaxResult MinMax::SolveWith(const Oracle& largest_cut, Until until) {
  MinMaxResult best;
  best.value = std::numeric_limits<double>::infinity();
  for (int pivot = 0; pivot < kMostPivots; ++pivot) {
    const Vector4d dual = Dual();
    const Vector3d point = dual.head<3>();
    const double bound = -dual[3];
    if (bound > rounding_ && IsSeparated()) {
      best.overlap = Overlap::kNone;
      return best;
    }
    Cut largest = largest_cut(centre_ + point);
    largest.offset += largest.gradient.dot(centre_);
    const double value = largest.At(point);
    if (value < best.value) {
      best.value = value;
      best.point = centre_ + point;
      if (value < -rounding_) best.overlap = Overlap::kSome;
    }
    if (until == Until::kSign && best.overlap == Overlap::kSome) return best;
    // Nothing is decided where the gap is small beside a value that is smaller still.
    const bool near = best.value - bound <= kRelativeGap * std::abs(best.value);
    if ((near && best.overlap == Overlap::kSome) || value - bound <= rounding_) return best;
    Enter(largest);
  }
  return best;
}

MinMaxResult MinMax::Solve(std::span<const UnionVolume> volumes, Until until) {
  return SolveWith(
      [&](const Vector3d& point) {
        Cut largest = volumes.front().CutAt(point);
        double value = largest.At(point);
        for (const UnionVolume& volume : volumes.subspan(1)) {
          const Cut cut = volume.CutAt(point);
          const double at = cut.At(point);
          if (at <= value) continue;
          value = at;
          largest = cut;
        }
        return largest;
      },
      until);
}

MinMaxResult MinMax::Solve(const LargestCut& largest_cut, Until until) {
  return SolveWith(largest_cut, until);
}

}  // namespace regrasp
