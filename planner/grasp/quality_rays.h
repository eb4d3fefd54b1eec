#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Wrenches that contact forces with Σ n_i·f_i <= 1 can apply.
/// This is the convex hull of the origin and of the rim wrenches of all contacts (rims of unit
/// normal force). Its largest ball about the origin is Ferrari and Canny's quality.
template <int kDim>
class WrenchSet {
 public:
  using Vector = Eigen::Matrix<double, kDim, 1>;

  /// @param contacts  force-closure contacts with rims of unit normal force; must outlive this
  ///     object.
  explicit WrenchSet(std::span<const UnitContact> contacts);

  struct SupportPoint {
    double value;  ///< largest y · w over the set
    Vector point;  ///< wrench w that attains the maximum
  };
  [[nodiscard]] SupportPoint Support(const Vector& twist) const;

  struct Hit {
    double distance;  ///< distance · direction is in the set
    Vector normal;    ///< twist y for which the set's support is close to y · (distance direction)
  };
  /// Return how far the set reaches from the origin along a unit direction.
  /// The search stops at `gap`, or when the distance exceeds `enough`.
  [[nodiscard]] Hit Shoot(const Vector& direction, double gap, double enough) const;

  /// Return the wrench of a rim force.
  /// @param angle  angle around the normal; in the plane only the sign of its cosine matters.
  [[nodiscard]] Vector RimWrench(int contact, double angle) const;

  /// Return the wrench of a normal force with the largest torque about it, with the given sign.
  [[nodiscard]] Vector TorsionWrench(int contact, double sign) const;
  [[nodiscard]] bool has_torsion(int contact) const { return contacts_[contact].torsion > 0; }

  [[nodiscard]] int contact_count() const { return static_cast<int>(contacts_.size()); }
  [[nodiscard]] static Vector Origin() { return Vector::Zero(); }

 private:
  std::span<const UnitContact> contacts_;
  WrenchSimplex<kDim> simplex_;
};

extern template class WrenchSet<3>;
extern template class WrenchSet<6>;

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

/// Decide for many grasps of one object, cheaply, whether their quality reaches a threshold.
///
/// In the direction of a unit twist, a grasp's wrenches (quality.h) reach as far as those of the
/// contact that reaches farthest. If that is less than the threshold, so is the quality. The filter
/// stores twists that refuted a grasp. They refute most other insufficient grasps, a hundred times
/// faster than ray shooting.
class QualityFilter {
 public:
  /// @param friction_angle  friction angle in radians.
  QualityFilter(const object::WrenchFrame& frame, double friction_angle);

  /// Return true only if ε ≥ threshold is certain.
  /// False if ε is smaller, and also for some grasps just above the threshold. Takes at most 0.2
  /// ms.
  /// @param grasp  contacts that are force closure at the friction angle.
  /// @param threshold  required lower bound of ε, above 0.
  [[nodiscard]] bool IsClearlyAtLeast(std::span<const Contact> grasp, double threshold);

  /// Number of grasps that required ray shooting.
  [[nodiscard]] std::int64_t shot_count() const { return shot_count_; }

 private:
  /// Twist; planar twists use the first three numbers.
  using Twist = Eigen::Matrix<double, 6, 1>;

  template <int kDim>
  [[nodiscard]] bool Decide(const UnitContacts& contacts, double threshold);
  template <int kDim>
  [[nodiscard]] bool IsRefuted(const UnitContacts& contacts, double threshold);

  object::WrenchFrame frame_;
  double friction_angle_;
  /// Stored twists; those that refuted a grasp recently are nearer to the front.
  std::vector<Twist> twists_;
  std::int64_t shot_count_ = 0;
};

}  // namespace regrasp::grasp
