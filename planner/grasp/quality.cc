#include "planner/grasp/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/grasp/cone_support.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_hull.h"
#include "planner/grasp/quality_rays.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::grasp {
namespace {

/// Number of rim forces per contact in the initial hull.
constexpr int kRimSamples = 6;

/// Number of facets refined per round: enough to cover the neighbourhood of the nearest point, few
/// enough that Qhull stays cheap. Its time grows steeply with the number of points.
constexpr int kFacetsPerRound = 24;

/// Search for a certified ball about the origin inside the wrench set, with Qhull.
/// The hull of some of the set's points is a lower bound. The set's support in the facets' normals
/// is an upper bound.
template <int kDim>
class BallSearch {
 public:
  BallSearch(const WrenchSet<kDim>& set, QualityBounds bounds) : set_(set), bounds_(bounds) {
    AddPoint(set.Origin());
    for (int contact = 0; contact < set.contact_count(); ++contact) {
      for (int s = 0; s < kRimSamples; ++s) {
        // The angle differs between contacts, so that parallel cones cause no parallel facets.
        const double angle = 2 * std::numbers::pi * (s + 0.1 * contact) / kRimSamples;
        AddPoint(set.RimWrench(contact, angle));
      }
      for (const double sign : {-1.0, 1.0}) {
        if (set.has_torsion(contact)) AddPoint(set.TorsionWrench(contact, sign));
      }
    }
  }

  [[nodiscard]] const QualityBounds& bounds() const { return bounds_; }
  [[nodiscard]] bool has_budget() const { return bounds_.facets < kMostQualityFacets; }

  /// Refine once.
  /// @returns false if no facet can be refined.
  bool Refine(double goal) {
    const ConvexHull hull = ComputeConvexHull(points_);
    bounds_.facets += static_cast<std::int64_t>(hull.facets.size());
    std::vector<const HullFacet*> facets;
    facets.reserve(hull.facets.size());
    for (const HullFacet& facet : hull.facets) facets.push_back(&facet);
    std::sort(facets.begin(), facets.end(),
              [](const auto* a, const auto* b) { return a->offset < b->offset; });
    bounds_.lower = std::max(bounds_.lower, facets.front()->offset - hull.joggle);
    int refined = 0;
    for (const HullFacet* facet : facets) {
      if (refined == kFacetsPerRound || facet->offset - hull.joggle >= goal * bounds_.upper) break;
      const auto support = set_.Support(facet->normal);
      bounds_.upper = std::min(bounds_.upper, support.value);
      // A point that is on the facet up to the joggle would only require a larger joggle.
      if (support.value - facet->offset <= hull.joggle) continue;
      AddPoint(support.point);
      ++refined;
    }
    return refined > 0;
  }

 private:
  void AddPoint(const Eigen::Matrix<double, kDim, 1>& point) {
    points_.conservativeResize(kDim, points_.cols() + 1);
    points_.col(points_.cols() - 1) = point;
  }

  const WrenchSet<kDim>& set_;
  Eigen::MatrixXd points_{kDim, 0};
  QualityBounds bounds_;
};

template <int kDim>
QualityBounds Quality(const UnitContacts& contacts, double relative_gap) {
  const WrenchSet<kDim> set(contacts);
  BallSearch<kDim> search(set, {0, std::numeric_limits<double>::infinity()});
  const QualityBounds& bounds = search.bounds();
  while (search.has_budget() && search.Refine(1 - relative_gap)) {
    if (bounds.upper - bounds.lower <= std::max(relative_gap * bounds.upper, kQualityGap)) break;
  }
  return bounds;
}

template <int kDim>
bool AtLeast(const UnitContacts& contacts, double threshold) {
  const WrenchSet<kDim> set(contacts);
  RaySearch<kDim> rays(set, threshold);
  rays.Run();
  BallSearch<kDim> balls(set, rays.bounds());
  const QualityBounds& bounds = balls.bounds();
  while (bounds.lower < threshold && bounds.upper >= threshold && balls.has_budget()) {
    if (!balls.Refine(threshold / bounds.upper)) break;
  }
  return bounds.lower >= threshold;
}

UnitContacts UnitNormalContacts(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                                double friction_angle) {
  UnitContacts units = MakeUnitContacts(contacts, frame);
  SetUnitNormalForces(units, friction_angle);
  return units;
}

}  // namespace

std::string QualityText(const QualityBounds& quality, int digits) {
  constexpr double kAgree = 0.02;
  const std::string lower = FormatShort(quality.lower, digits);
  if (quality.upper - quality.lower <= kAgree * quality.upper) return lower;
  return "at least " + lower + ", at most " + FormatShort(quality.upper, digits);
}

QualityBounds ComputeQuality(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                             double friction_angle, double relative_gap) {
  if (!(relative_gap > 0))
    throw std::invalid_argument("quality: the relative gap must be positive");
  if (!IsForceClosure(contacts, frame, friction_angle)) return {};
  const UnitContacts units = UnitNormalContacts(contacts, frame, friction_angle);
  return frame.dimension == 3 ? Quality<6>(units, relative_gap) : Quality<3>(units, relative_gap);
}

bool QualityAtLeast(std::span<const Contact> contacts, const object::WrenchFrame& frame,
                    double friction_angle, double threshold) {
  if (!std::isfinite(threshold))
    throw std::invalid_argument("quality: the threshold must be finite");
  if (!IsForceClosure(contacts, frame, friction_angle)) return threshold <= 0;
  if (threshold <= 0) return true;
  const UnitContacts units = UnitNormalContacts(contacts, frame, friction_angle);
  return frame.dimension == 3 ? AtLeast<6>(units, threshold) : AtLeast<3>(units, threshold);
}

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
    throw std::invalid_argument("quality: the relative gap must be at least 1e-5");
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
