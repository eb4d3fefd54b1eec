#include "planner/grasp/growing_ball.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/growing_hull.h"

namespace regrasp::grasp {
namespace {

/// Radius of the hull's initial simplex, over the largest force. Rounding errors are smallest for a
/// simplex that is not much smaller than the wrench set. The radius must be smaller than ε; the
/// simplex is then inside the final hull.
constexpr double kCore = 1e-3;

/// Radius if ε proves to be smaller than kCore: below every gap that is refined.
constexpr double kLeastCore = kQualityGap / 2;

/// Largest Residual of the hull (growing_hull.h), over the relative gap.
constexpr double kLargestResidual = 1e-3;

template <int kDim>
struct SupportPoint {
  double value = 0;
  Eigen::Matrix<double, kDim, 1> point = Eigen::Matrix<double, kDim, 1>::Zero();
};

/// Wrenches that contacts with Σ n_i·f_i ≤ 1 apply, shifted by a load.
template <int kDim>
struct ShiftedWrenches {
  using Vector = Eigen::Matrix<double, kDim, 1>;
  const UnitContacts& contacts;
  Vector load = Vector::Zero();

  /// Return the farthest wrench along a unit twist.
  [[nodiscard]] SupportPoint<kDim> Farthest(const Vector& twist) const {
    SupportPoint<kDim> farthest;
    const UnitContact* best = nullptr;
    for (const UnitContact& contact : contacts) {
      const double value = ConeSupportOf<kDim>(contact, twist.data());
      if (value <= farthest.value) continue;
      farthest.value = value;
      best = &contact;
    }
    if (best != nullptr) {
      const ContactWrench wrench = SupportWrench<kDim>(*best, Velocity<kDim>(*best, twist.data()),
                                                       Spin<kDim>(*best, twist.data()));
      WriteWrench<kDim>(*best, wrench, farthest.point.data());
    }
    farthest.value += load.dot(twist);
    farthest.point += load;
    return farthest;
  }
};

/// Return the distance at which a plane of the hull needs no more refinement.
/// A hundredth of the gap covers the rounding of the lower bound.
double GoalOf(double upper, double relative_gap) {
  const double goal = upper - 0.99 * std::max(relative_gap * upper, kQualityGap);
  // Distances up to the radius of the core prove nothing.
  return upper <= kQualityGap ? goal : std::max(goal, 1.001 * kLeastCore);
}

/// Grow a hull from a simplex until its ball meets the goal.
/// @returns bounds; nullopt if rounding broke the hull, or if ε may be less than the simplex's
///     radius.
template <int kDim>
std::optional<QualityBounds> GrowFrom(const ShiftedWrenches<kDim>& wrenches, const BallGoal& goal,
                                      double core, std::int64_t& facets) {
  thread_local GrowingHull<kDim> hull;  // static, to reuse its memory for the next grasp
  hull.Start(core);
  const double relative_gap = goal.relative_gap;
  double upper = std::numeric_limits<double>::infinity();
  double lower = 0;
  while (true) {
    const auto nearest = hull.Nearest();
    lower = nearest ? nearest->distance : GoalOf(upper, relative_gap);
    if (!nearest || facets + hull.created() >= kMostQualityFacets) break;
    const SupportPoint<kDim> farthest = wrenches.Farthest(nearest->normal);
    if (farthest.value < upper) {
      upper = farthest.value;
      if (upper <= 0 || upper < goal.decided_at) {
        return QualityBounds{0, std::max(upper, 0.0), facets + hull.created()};
      }
      if (core > kLeastCore && upper <= 2 * core) break;
      hull.SetLimit(GoalOf(upper, relative_gap));
    }
    if (lower >= GoalOf(upper, relative_gap)) break;
    if (lower > 2 * core && goal.IsDecided((1 - kLargestResidual) * lower, upper)) break;
    if (!hull.Insert(nearest->facet, farthest.point)) return std::nullopt;
  }
  facets += hull.created();
  if (core > kLeastCore && upper <= 2 * core) return std::nullopt;
  const double residual = hull.Residual();
  if (!(residual <= kLargestResidual * relative_gap)) return std::nullopt;
  // A plane through a corner of the simplex is at most that far away.
  if (lower <= core) lower = 0;
  return QualityBounds{std::clamp((1 - residual) * lower, 0.0, upper), upper, facets};
}

}  // namespace

template <int kDim>
std::optional<QualityBounds> GrowBall(const UnitContacts& contacts, const LoadVector<kDim>& load,
                                      double friction, const BallGoal& goal) {
  ShiftedWrenches<kDim> wrenches{contacts};
  if (load) wrenches.load = *load;
  std::int64_t facets = 0;
  for (const double core : {kCore * std::max(1.0, friction), kCore, kLeastCore}) {
    if (const auto bounds = GrowFrom<kDim>(wrenches, goal, core, facets)) return bounds;
  }
  return std::nullopt;
}

template std::optional<QualityBounds> GrowBall<3>(const UnitContacts&, const LoadVector<3>&, double,
                                                  const BallGoal&);
template std::optional<QualityBounds> GrowBall<6>(const UnitContacts&, const LoadVector<6>&, double,
                                                  const BallGoal&);

}  // namespace regrasp::grasp
