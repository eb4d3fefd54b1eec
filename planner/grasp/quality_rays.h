#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/grasp/quality.h"
#include "planner/grasp/wrench_set.h"

namespace regrasp::grasp {

/// Relative gap, and multiple of the threshold, at which ray shooting stops: more precision cannot
/// change the decision.
inline constexpr double kShootGap = 0.02;
inline constexpr double kShootEnough = 8;

/// Number of direction frames before Qhull is used: a frame takes about 20 µs, Qhull a thousand
/// times that.
inline constexpr int kFrames = 8;

/// Number of descents from the nearest known boundary point to a nearer one.
inline constexpr int kDescents = 6;

/// Decide by ray shooting whether a quality reaches a threshold.
/// The boundary points on ± the columns of an orthogonal frame span a cross-polytope inside the
/// set, which is a lower bound. The normal of each hit is an upper bound on the ball.
template <int kDim>
class RaySearch {
 public:
  using Vector = typename WrenchSet<kDim>::Vector;
  using Frame = Eigen::Matrix<double, kDim, kDim>;

  RaySearch(const WrenchSet<kDim>& set, double threshold) : set_(set), threshold_(threshold) {}

  [[nodiscard]] const QualityBounds& bounds() const { return bounds_; }
  /// Unit twist of the upper bound.
  [[nodiscard]] const Vector& nearest() const { return nearest_; }
  [[nodiscard]] bool decided() const {
    return bounds_.lower >= threshold_ || bounds_.upper < threshold_;
  }

  /// Shoot rays until the decision, or for at most 0.2 ms.
  void Run() {
    ShootFrame(Frame::Identity());
    for (int frame = 1; frame < kFrames && !decided(); ++frame) {
      Descend();
      if (!decided()) ShootFrame(NearestFrame());
    }
  }

 private:
  /// Bound the quality by the ball inside the frame's cross-polytope.
  /// The facets of the cross-polytope, one per choice of signs, are 1 / √Σ 1/s² from the origin.
  void ShootFrame(const Frame& frame) {
    double sum = 0;
    for (int axis = 0; axis < kDim && !decided(); ++axis) {
      const double shorter = std::min(Shoot(frame.col(axis)), Shoot(-frame.col(axis)));
      sum += 1 / (shorter * shorter);
    }
    if (!decided()) bounds_.lower = std::max(bounds_.lower, 1 / std::sqrt(sum));
  }

  /// Shoot along the normal of the nearest known supporting plane, towards a nearer boundary point.
  /// This never increases the bound (descent on the support function).
  void Descend() {
    for (int step = 0; step < kDescents && !decided(); ++step) {
      const double before = bounds_.upper;
      Shoot(nearest_);
      if (bounds_.upper > (1 - kShootGap) * before) break;
    }
  }

  /// Return an orthogonal frame whose first axis is the nearest normal.
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
