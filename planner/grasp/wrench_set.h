#pragma once

#include <Eigen/Core>

#include "planner/grasp/unit_contacts.h"
#include "planner/grasp/wrench_simplex.h"

namespace regrasp::grasp {

/// The wrenches that contact forces with Σ n_i·f_i <= 1 can apply: the convex hull of the origin
/// and of the rim wrenches of all contacts (rims of unit normal force). The set whose largest ball
/// is Ferrari and Canny's quality.
template <int kDim>
class WrenchSet {
 public:
  using Vector = Eigen::Matrix<double, kDim, 1>;

  /// @param contacts  force closure, rims of unit normal force; must stay alive.
  explicit WrenchSet(std::span<const UnitContact> contacts);

  struct SupportPoint {
    double value;  ///< the largest y · w over the set
    Vector point;  ///< a w that attains it
  };
  [[nodiscard]] SupportPoint Support(const Vector& twist) const;

  struct Hit {
    double distance;  ///< distance · direction lies in the set
    Vector normal;    ///< a twist y; the set's support in y is close to y · (distance direction)
  };
  /// How far the set reaches from the origin along a unit direction, to within `gap`, or until the
  /// distance is more than `enough`.
  [[nodiscard]] Hit Shoot(const Vector& direction, double gap, double enough) const;

  /// The wrench of a rim force, by its angle around the normal (in the plane: by its cosine's
  /// sign).
  [[nodiscard]] Vector RimWrench(int contact, double angle) const;

  /// The wrench of a normal force with the largest torque about it, of that sign.
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
