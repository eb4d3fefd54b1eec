#include "planner/criteria/grasp_criteria.h"

#include <array>

#include "planner/criteria/reach.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/quality_filter.h"

namespace regrasp::criteria {

namespace {

/// Of qualities that are only compared: to a hundredth they would take ten times as long.
constexpr double kScoreGap = 0.1;

}  // namespace

bool MeetsCriteria(const grasp::Grasp& grasp, const object::WrenchFrame& frame,
                   const GraspCriteria& criteria, grasp::QualityFilter* filter) {
  if (criteria.min_quality <= 0) return true;
  if (filter != nullptr) return filter->IsClearlyAtLeast(grasp, criteria.min_quality);
  return grasp::QualityAtLeast(grasp, frame, criteria.half_angle, criteria.min_quality);
}

double Shortfall(const grasp::Grasp& grasp, const object::WrenchFrame& frame,
                 const GraspCriteria& criteria) {
  return grasp::ComputeQuality(grasp, frame, criteria.half_angle, kScoreGap).lower /
             criteria.min_quality -
         1;
}

bool CanMeet(const grasp::Contact& a, const grasp::Contact& b, double same_point,
             double fingertip_radius) {
  if ((a.p - b.p).squaredNorm() <= same_point * same_point) return false;
  return fingertip_radius <= 0 || KeepApart(std::array{a, b}, fingertip_radius);
}

bool CanAllMeet(const grasp::Grasp& grasp, double same_point, double fingertip_radius) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!CanMeet(grasp[i], grasp[j], same_point, fingertip_radius)) return false;
    }
  }
  return true;
}

}  // namespace regrasp::criteria
