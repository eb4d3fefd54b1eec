#include "planner/criteria/grasp_criteria.h"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/quality_rays.h"

namespace regrasp::criteria {

namespace {

using Contacts = std::span<const grasp::Contact>;

/// Relative accuracy of measures: coarse for comparisons, because 0.01 takes ten times as long, and
/// fine for messages.
constexpr double kScoreGap = 0.1;
constexpr double kToldGap = 0.01;

/// Criterion beyond force closure, with a minimum.
struct Criterion {
  const char* name;              ///< noun in messages, without "a"
  double GraspCriteria::*asked;  ///< required minimum; 0: not required
  /// Test of the criterion.
  /// @param filter  can be null.
  bool (*is_met)(Contacts, const object::WrenchFrame&, const GraspCriteria&,
                 grasp::QualityFilter* filter);
  /// Lower bound of the measured value.
  /// @param gap  accuracy relative to the bound.
  double (*measure)(Contacts, const object::WrenchFrame&, const GraspCriteria&, double gap);
};

bool HasQuality(Contacts grasp, const object::WrenchFrame& frame, const GraspCriteria& criteria,
                grasp::QualityFilter* filter) {
  if (filter != nullptr) return filter->IsClearlyAtLeast(grasp, criteria.min_quality);
  return grasp::QualityAtLeast(grasp, frame, criteria.friction_angle, criteria.min_quality);
}

double QualityOf(Contacts grasp, const object::WrenchFrame& frame, const GraspCriteria& criteria,
                 double gap) {
  return grasp::ComputeQuality(grasp, frame, criteria.friction_angle, gap).lower;
}

constexpr std::array kCriteria = {
    Criterion{"quality", &GraspCriteria::min_quality, HasQuality, QualityOf},
};

}  // namespace

bool GraspCriteria::AsksMore() const {
  return std::ranges::any_of(kCriteria, [this](const Criterion& c) { return this->*c.asked > 0; });
}

GraspCriteria GraspCriteria::Relaxed(double share) const {
  GraspCriteria relaxed = *this;
  for (const Criterion& criterion : kCriteria) relaxed.*criterion.asked *= share;
  return relaxed;
}

bool MeetsCriteria(Contacts grasp, const object::WrenchFrame& frame, const GraspCriteria& criteria,
                   grasp::QualityFilter* filter) {
  return std::ranges::all_of(kCriteria, [&](const Criterion& criterion) {
    return criteria.*criterion.asked <= 0 || criterion.is_met(grasp, frame, criteria, filter);
  });
}

double Shortfall(Contacts grasp, const object::WrenchFrame& frame, const GraspCriteria& criteria) {
  double least = std::numeric_limits<double>::infinity();
  for (const Criterion& criterion : kCriteria) {
    const double asked = criteria.*criterion.asked;
    if (asked <= 0) continue;
    least = std::min(least, criterion.measure(grasp, frame, criteria, kScoreGap) / asked - 1);
  }
  return least;
}

std::vector<UnmetCriterion> FindUnmet(Contacts grasp, const object::WrenchFrame& frame,
                                      const GraspCriteria& criteria) {
  std::vector<UnmetCriterion> unmet;
  for (const Criterion& criterion : kCriteria) {
    const double asked = criteria.*criterion.asked;
    if (asked <= 0) continue;
    const double reached = criterion.measure(grasp, frame, criteria, kToldGap);
    if (reached < asked) unmet.push_back({criterion.name, asked, reached});
  }
  return unmet;
}

std::string WithWhatIsAsked(const GraspCriteria& criteria) {
  std::string text;
  for (const Criterion& criterion : kCriteria) {
    const double asked = criteria.*criterion.asked;
    if (asked <= 0) continue;
    text += (text.empty() ? " with a " : " and a ") + std::string(criterion.name) +
            " of at least " + FormatShort(asked);
  }
  return text;
}

bool CanMeet(const grasp::Contact& a, const grasp::Contact& b, double same_point,
             double fingertip_radius) {
  if ((a.p - b.p).squaredNorm() <= same_point * same_point) return false;
  return fingertip_radius <= 0 || KeepApart(std::array{a, b}, fingertip_radius);
}

bool CanAllMeet(Contacts grasp, double same_point, double fingertip_radius) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!CanMeet(grasp[i], grasp[j], same_point, fingertip_radius)) return false;
    }
  }
  return true;
}

}  // namespace regrasp::criteria
