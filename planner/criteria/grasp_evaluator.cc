#include "planner/criteria/grasp_evaluator.h"

#include <algorithm>

#include "planner/criteria/clearance.h"
#include "planner/criteria/reach.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp::criteria {

namespace {

/// Of required half-angles that are only compared, radians.
constexpr double kScoreAccuracy = 1e-5;

std::vector<double> NumbersOf(const grasp::Grasp& grasp) {
  std::vector<double> numbers;
  for (const grasp::Contact& contact : grasp) {
    numbers.insert(numbers.end(), contact.p.begin(), contact.p.end());
    numbers.insert(numbers.end(), contact.n.begin(), contact.n.end());
    numbers.push_back(contact.face);
  }
  return numbers;
}

}  // namespace

GraspEvaluator::GraspEvaluator(const object::Object& object, const GraspCriteria& criteria,
                               const hand::Hand& hand)
    : object_(object),
      frame_(object.wrench_frame()),
      criteria_(criteria),
      hand_(hand),
      same_point_(kSamePoint * object.diameter()) {}

bool GraspEvaluator::CanAllMeet(const grasp::Grasp& grasp) const {
  return criteria::CanAllMeet(grasp, same_point_, finger_radius());
}

bool GraspEvaluator::AreReachable(const grasp::Grasp& contacts) const {
  return std::ranges::all_of(contacts, [&](const grasp::Contact& contact) {
    return HasClearance(object_, contact) && CanReach(object_, contact, finger_radius());
  });
}

bool GraspEvaluator::IsReachable(const grasp::Grasp& grasp) const {
  return CanAllMeet(grasp) && AreReachable(grasp);
}

bool GraspEvaluator::IsGood(const grasp::Grasp& grasp) const {
  // What takes least time and refuses most comes first.
  return CanAllMeet(grasp) && grasp::IsForceClosure(grasp, frame_, half_angle()) &&
         MeetsCriteria(grasp, frame_, criteria_) && AreReachable(grasp);
}

double GraspEvaluator::Score(const grasp::Grasp& grasp) const {
  const auto [known, is_new] = scores_.try_emplace(NumbersOf(grasp), 0);
  if (is_new) known->second = ComputeScore(grasp);
  return known->second;
}

double GraspEvaluator::ComputeScore(const grasp::Grasp& grasp) const {
  if (!IsReachable(grasp) || !grasp::IsForceClosure(grasp, frame_, half_angle())) return -1;
  if (!MeetsCriteria(grasp, frame_, criteria_)) return Shortfall(grasp, frame_, criteria_);
  const auto required = grasp::ComputeRequiredHalfAngle(grasp, frame_, kScoreAccuracy);
  return required ? std::max(half_angle() - required->upper, 0.0) : 0;
}

double GraspEvaluator::Quality(const grasp::Grasp& grasp) const {
  return grasp::ComputeQuality(grasp, frame_, half_angle()).lower;
}

}  // namespace regrasp::criteria
