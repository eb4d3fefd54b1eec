#pragma once

#include <Eigen/Core>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

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
    Vector point;  ///< a w that attains it
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

}  // namespace regrasp::grasp
