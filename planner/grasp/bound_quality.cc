#include "planner/grasp/bound_quality.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

/// Radius of the simplex that the hull starts from. A facet of the final hull that still has a
/// corner of it is no farther away, below every gap that is refined.
constexpr double kCore = kQualityGap / 2;

/// Facets may miss their corners by this part of their distance: a fifth of what the corners are
/// shrunk by at least, so that the hull stays inside the wrench set.
constexpr double kLargestResidual = 1e-8;

template <int kDim>
struct SupportPoint {
  double value = 0;
  Eigen::Matrix<double, kDim, 1> point = Eigen::Matrix<double, kDim, 1>::Zero();
};

/// The farthest wrench of all contacts along a unit twist.
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
  const ContactWrench wrench =
      SupportWrench<kDim>(*best, Velocity<kDim>(*best, twist.data()), Spin<kDim>(*best, twist.data()));
  WriteWrench<kDim>(*best, wrench, farthest.point.data());
  return farthest;
}

template <int kDim>
std::optional<QualityBounds> GrowBall(const UnitContacts& contacts, double relative_gap) {
  thread_local GrowingHull<kDim> hull;  // its memory serves the next grasp
  hull.Start(kCore);
  QualityBounds bounds{0, std::numeric_limits<double>::infinity()};
  while (true) {
    const auto nearest = hull.Nearest();
    const SupportPoint<kDim> farthest = FarthestWrench<kDim>(contacts, nearest.normal);
    bounds.lower = nearest.distance > kCore ? nearest.distance : 0;
    bounds.upper = std::min(bounds.upper, farthest.value);
    bounds.facets = hull.created();
    const double gap = std::max(relative_gap * bounds.upper, kQualityGap);
    if (bounds.upper - bounds.lower <= gap || bounds.facets >= kMostQualityFacets) break;
    if (!hull.Insert(nearest.facet, farthest.point)) return std::nullopt;
  }
  // Also refuses what is not a number.
  if (!(hull.Residual() <= kLargestResidual)) return std::nullopt;
  bounds.lower = std::min(bounds.lower, bounds.upper);
  return bounds;
}

}  // namespace

std::optional<QualityBounds> BoundQualityByHull(std::span<const Contact> contacts,
                                                const object::WrenchFrame& frame,
                                                double half_angle, double relative_gap) {
  if (!(relative_gap >= kLeastRelativeGap)) {
    throw std::invalid_argument("quality: relative gap below 1e-5");
  }
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, half_angle);
  return frame.dimension == 3 ? GrowBall<6>(units, relative_gap) : GrowBall<3>(units, relative_gap);
}

QualityBounds BoundQuality(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                           double half_angle, double relative_gap) {
  if (!IsForceClosure(contacts, frame, half_angle)) return {};
  if (const auto bounds = BoundQualityByHull(contacts, frame, half_angle, relative_gap)) {
    return *bounds;
  }
  return ComputeQuality(contacts, frame, half_angle, relative_gap);
}

}  // namespace regrasp::grasp
