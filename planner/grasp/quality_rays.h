#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/quality.h"
#include "planner/grasp/wrench_set.h"

namespace regrasp::grasp {

/// Ray shooting ends at this part of the threshold, and where the set reaches this many times it:
/// beyond, nothing that would change the decision is learned.
inline constexpr double kShootGap = 0.02;
inline constexpr double kShootEnough = 8;

/// Frames of directions tried before Qhull is asked: one takes some 20 µs, Qhull a thousand times
/// that.
inline constexpr int kFrames = 8;

/// Descents from the nearest boundary point found so far to a nearer one.
inline constexpr int kDescents = 6;

/// Decides by shooting rays whether a quality reaches a threshold. What they tell: the boundary
/// points on ± the columns of an orthogonal frame span a cross-polytope inside the set, and each
/// hit's normal bounds the ball from above.
template <int kDim>
class RaySearch {
 public:
  using Vector = typename WrenchSet<kDim>::Vector;
  using Frame = Eigen::Matrix<double, kDim, kDim>;

  RaySearch(const WrenchSet<kDim>& set, double threshold) : set_(set), threshold_(threshold) {}

  [[nodiscard]] const QualityBounds& bounds() const { return bounds_; }
  /// The unit twist that the upper bound was found with.
  [[nodiscard]] const Vector& nearest() const { return nearest_; }
  [[nodiscard]] bool decided() const {
    return bounds_.lower >= threshold_ || bounds_.upper < threshold_;
  }

  /// Shoots rays until the question is decided, or has cost a fifth of a millisecond.
  void Run() {
    ShootFrame(Frame::Identity());
    for (int frame = 1; frame < kFrames && !decided(); ++frame) {
      Descend();
      if (!decided()) ShootFrame(NearestFrame());
    }
  }

 private:
  /// The ball inside the cross-polytope of the frame: its facets, one of each ± pair, are
  /// 1 / √Σ 1/s² from the origin.
  void ShootFrame(const Frame& frame) {
    double sum = 0;
    for (int axis = 0; axis < kDim && !decided(); ++axis) {
      const double shorter = std::min(Shoot(frame.col(axis)), Shoot(-frame.col(axis)));
      sum += 1 / (shorter * shorter);
    }
    if (!decided()) bounds_.lower = std::max(bounds_.lower, 1 / std::sqrt(sum));
  }

  /// The normal of the boundary at the nearest known supporting plane is where a nearer boundary
  /// point is: shooting along it never gives a larger bound (the support function's descent).
  void Descend() {
    for (int step = 0; step < kDescents && !decided(); ++step) {
      const double before = bounds_.upper;
      Shoot(nearest_);
      if (bounds_.upper > (1 - kShootGap) * before) break;
    }
  }

  /// An orthogonal frame whose first axis is the nearest normal.
  [[nodiscard]] Frame NearestFrame() const {
    return Eigen::HouseholderQR<Vector>(nearest_).householderQ();
  }

  double Shoot(const Vector& direction) {
    const auto hit = set_.Shoot(direction, kShootGap * threshold_, kShootEnough * threshold_);
    const double size = hit.normal.norm();
    if (size > 0) {
      const Vector normal = hit.normal / size;
      const double support = set_.Support(normal).value;
      if (support < bounds_.upper) {
        bounds_.upper = support;
        nearest_ = normal;
      }
    }
    return std::max(hit.distance, std::numeric_limits<double>::min());
  }

  const WrenchSet<kDim>& set_;
  double threshold_;
  Vector nearest_ = Vector::UnitX();
  QualityBounds bounds_{0, std::numeric_limits<double>::infinity()};
};

}  // namespace regrasp::grasp
