#include "planner/grasp/bound_quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
#include "planner/grasp/unit_contacts.h"

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

/// Friction coefficient above which the set is so flat that Qhull takes minutes.
constexpr double kMostFriction = 1e3;

template <int kDim>
struct SupportPoint {
  double value = 0;
  Eigen::Matrix<double, kDim, 1> point = Eigen::Matrix<double, kDim, 1>::Zero();
};

/// Return the farthest wrench of all contacts along a unit twist.
template <int kDim>
SupportPoint<kDim> FarthestWrench(const UnitContacts& contacts,
                                  const Eigen::Matrix<double, kDim, 1>& twist) {
  SupportPoint<kDim> farthest;
  const UnitContact* best = nullptr;
  for (const UnitContact& contact : contacts) {
    const double value = ConeSupportOf<kDim>(contact, twist.data());
    if (value <= farthest.value) continue;
    farthest.value = value;
    best = &contact;
  }
  if (best == nullptr) return farthest;
  const ContactWrench wrench = SupportWrench<kDim>(*best, Velocity<kDim>(*best, twist.data()),
                                                   Spin<kDim>(*best, twist.data()));
  WriteWrench<kDim>(*best, wrench, farthest.point.data());
  return farthest;
}

/// Return the distance at which a facet needs no more refinement.
/// A hundredth of the gap covers the rounding of the lower bound.
double GoalOf(double upper, double relative_gap) {
  const double goal = upper - 0.99 * std::max(relative_gap * upper, kQualityGap);
  // Distances up to the radius of the core prove nothing.
  return upper <= kQualityGap ? goal : std::max(goal, 1.001 * kLeastCore);
}

/// Grow a hull from a simplex until its ball is within the gap.
/// @returns bounds; nullopt if rounding broke the hull, or if ε may be less than the simplex's
///     radius.
template <int kDim>
std::optional<QualityBounds> GrowBall(const UnitContacts& contacts, double relative_gap,
                                      double core, std::int64_t& facets) {
  thread_local GrowingHull<kDim> hull;  // static, to reuse its memory for the next grasp
  hull.Start(core);
  double upper = std::numeric_limits<double>::infinity();
  double lower = 0;
  while (true) {
    const auto nearest = hull.Nearest();
    lower = nearest ? nearest->distance : GoalOf(upper, relative_gap);
    if (!nearest || facets + hull.created() >= kMostQualityFacets) break;
    const SupportPoint<kDim> farthest = FarthestWrench<kDim>(contacts, nearest->normal);
    if (farthest.value < upper) {
      upper = farthest.value;
      if (core > kLeastCore && upper <= 2 * core) break;
      hull.SetLimit(GoalOf(upper, relative_gap));
    }
    if (lower >= GoalOf(upper, relative_gap)) break;
    if (!hull.Insert(nearest->facet, farthest.point)) return std::nullopt;
  }
  facets += hull.created();
  if (core > kLeastCore && upper <= 2 * core) return std::nullopt;
  const double residual = hull.Residual();
  if (!(residual <= kLargestResidual * relative_gap)) return std::nullopt;
  // A facet with a corner of the simplex is at most that far away.
  if (lower <= core) lower = 0;
  return QualityBounds{std::clamp((1 - residual) * lower, 0.0, upper), upper, facets};
}

template <int kDim>
std::optional<QualityBounds> BoundByHulls(const UnitContacts& contacts, double friction,
                                          double relative_gap) {
  std::int64_t facets = 0;
  for (const double core : {kCore * std::max(1.0, friction), kCore, kLeastCore}) {
    if (const auto bounds = GrowBall<kDim>(contacts, relative_gap, core, facets)) return bounds;
  }
  return std::nullopt;
}

}  // namespace

std::optional<QualityBounds> BoundQualityByHull(std::span<const Contact> contacts,
                                                const object::WrenchFrame& frame,
                                                double friction_angle, double relative_gap) {
  if (!(relative_gap >= kLeastRelativeGap)) {
    throw std::invalid_argument("quality: relative gap below 1e-5");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  const double friction = std::tan(friction_angle);
  return frame.dimension == 3 ? BoundByHulls<6>(units, friction, relative_gap)
                              : BoundByHulls<3>(units, friction, relative_gap);
}

QualityBounds BoundQuality(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                           double friction_angle, double relative_gap) {
  if (!IsForceClosure(contacts, frame, friction_angle)) return {};
  if (const auto bounds = BoundQualityByHull(contacts, frame, friction_angle, relative_gap)) {
    return *bounds;
  }
  if (std::tan(friction_angle) <= kMostFriction) {
    return ComputeQuality(contacts, frame, friction_angle, relative_gap);
  }
  return {0, std::hypot(1, std::tan(friction_angle)),
          0};  // no twist has a larger support everywhere
}

}  // namespace regrasp::grasp
