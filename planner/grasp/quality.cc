#include "planner/grasp/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/growing_ball.h"
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

/// Friction coefficient above which the set is so flat that Qhull takes minutes.
constexpr double kMostFriction = 1e3;

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
  const BallGoal goal{relative_gap};
  return frame.dimension == 3 ? GrowBall<6>(units, {}, friction, goal)
                              : GrowBall<3>(units, {}, friction, goal);
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
