#pragma once

#include <Eigen/Core>
#include <optional>

#include "planner/grasp/quality.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {

/// Conditions that end the refinement of a ball.
struct BallGoal {
  double relative_gap;
  /// End when the radius is known to be below, or at least, this value; 0: never.
  double decided_at = 0;

  [[nodiscard]] bool IsDecided(double lower, double upper) const {
    return decided_at > 0 && (upper < decided_at || lower >= decided_at);
  }
};

/// Load of a grasp as kDim numbers (cone_support.h).
template <int kDim>
using LoadVector = std::optional<Eigen::Matrix<double, kDim, 1>>;

/// Bound the radius of the largest ball about the origin inside the wrenches of contacts with
/// Σ n_i·f_i ≤ 1, shifted by a load.
/// One hull of wrenches grows at its plane nearest to the origin (GrowingHull).
/// @param contacts  contacts with the rims of unit normal forces.
/// @param load      load of the grasp; none: 0.
/// @param friction  friction coefficient.
/// @returns bounds; nullopt if rounding broke the hull.
template <int kDim>
[[nodiscard]] std::optional<QualityBounds> GrowBall(const UnitContacts& contacts,
                                                    const LoadVector<kDim>& load, double friction,
                                                    const BallGoal& goal);

extern template std::optional<QualityBounds> GrowBall<3>(const UnitContacts&, const LoadVector<3>&,
                                                         double, const BallGoal&);
extern template std::optional<QualityBounds> GrowBall<6>(const UnitContacts&, const LoadVector<6>&,
                                                         double, const BallGoal&);

}  // namespace regrasp::grasp
