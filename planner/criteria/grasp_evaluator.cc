#include "planner/criteria/grasp_evaluator.h"

#include <algorithm>

#include "planner/criteria/clearance.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp {

namespace {

/// Of required half-angles that are only compared, radians.
constexpr double kScoreAccuracy = 1e-5;

/// Of qualities that are only compared: to a hundredth they would take ten times as long.
constexpr double kScoreGap = 0.1;

std::vector<double> NumbersOf(const Grasp& grasp) {
  std::vector<double> numbers;
  for (const Contact& contact : grasp) {
    numbers.insert(numbers.end(), contact.p.begin(), contact.p.end());
    numbers.insert(numbers.end(), contact.n.begin(), contact.n.end());
    numbers.push_back(contact.face);
  }
  return numbers;
}

bool HaveDistinctPoints(const Grasp& grasp, double same_point) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = i + 1; j < grasp.size(); ++j) {
      if ((grasp[i].p - grasp[j].p).norm() <= same_point) return false;
    }
  }
  return true;
}

}  // namespace

GraspEvaluator::GraspEvaluator(const Object& object, const GraspCriteria& criteria,
                               const Hand& hand)
    : object_(object),
      frame_(object.wrench_frame()),
      criteria_(criteria),
      hand_(hand),
      same_point_(kSamePoint * object.diameter()) {}

bool GraspEvaluator::AreApart(const Grasp& grasp) const {
  return HaveDistinctPoints(grasp, same_point_) && KeepApart(grasp, finger_radius());
}

bool GraspEvaluator::AreReachable(const Grasp& grasp) const {
  return std::ranges::all_of(grasp, [&](const Contact& contact) {
    return HasClearance(object_, contact) && CanReach(object_, contact, finger_radius());
  });
}

bool GraspEvaluator::CanStand(const Grasp& grasp) const {
  return AreApart(grasp) && AreReachable(grasp);
}

bool GraspEvaluator::IsGood(const Grasp& grasp) const {
  return AreApart(grasp) && IsForceClosure(grasp, frame_, half_angle()) &&
         QualityAtLeast(grasp, frame_, half_angle(), min_quality()) && AreReachable(grasp);
}

double GraspEvaluator::Score(const Grasp& grasp) const {
  const auto [known, is_new] = scores_.try_emplace(NumbersOf(grasp), 0);
  if (is_new) known->second = ComputeScore(grasp);
  return known->second;
}

double GraspEvaluator::ComputeScore(const Grasp& grasp) const {
  if (!CanStand(grasp) || !IsForceClosure(grasp, frame_, half_angle())) {
    return -1;
  }
  if (!QualityAtLeast(grasp, frame_, half_angle(), min_quality())) {
    return ComputeQuality(grasp, frame_, half_angle(), kScoreGap).lower / min_quality() - 1;
  }
  const auto required = ComputeRequiredHalfAngle(grasp, frame_, kScoreAccuracy);
  return required ? std::max(half_angle() - required->upper, 0.0) : 0;
}

double GraspEvaluator::Quality(const Grasp& grasp) const {
  return ComputeQuality(grasp, frame_, half_angle()).lower;
}

}  // namespace regrasp
