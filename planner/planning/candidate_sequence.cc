#include "planner/planning/candidate_sequence.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "planner/base/deadline.h"
#include "planner/base/number.h"
#include "planner/planning/rest_summary.h"

namespace regrasp::planning {

CandidateSequence StartOf(const grasp::Grasp& grasp) {
  CandidateSequence candidate;
  candidate.initial = plan::FingersInOrder(grasp);
  candidate.rests = {{grasp, std::nullopt}};
  return candidate;
}

namespace {

bool SameContact(const grasp::Contact& a, const grasp::Contact& b) {
  return a.p == b.p && a.n == b.n;
}

bool Contains(const grasp::Grasp& grasp, const grasp::Contact& contact) {
  return std::any_of(grasp.begin(), grasp.end(),
                     [&](const grasp::Contact& other) { return SameContact(other, contact); });
}

FingerIndex LowestFreeFinger(const plan::FingerGrasp& holding, int fingers) {
  for (FingerIndex finger{0}; finger < fingers; ++finger) {
    if (plan::FindFinger(holding, finger) == nullptr) return finger;
  }
  throw std::invalid_argument("the hand has too few fingers for the switch");
}

}  // namespace

plan::Switch MakeSwitch(const plan::FingerGrasp& before, const grasp::Grasp& after, int fingers) {
  plan::Switch step;
  plan::FingerGrasp holding = before;
  const grasp::Grasp contacts_before = plan::ContactsOf(before);
  for (const grasp::Contact& contact : after) {
    if (Contains(contacts_before, contact)) continue;
    step.place.push_back({LowestFreeFinger(holding, fingers), contact});
    holding.push_back(step.place.back());
  }
  for (const plan::FingerContact& finger : before) {
    if (!Contains(after, finger.contact)) step.release.push_back(finger.finger);
  }
  return step;
}

CandidateSequence MakeSwitchSequence(std::span<const grasp::Grasp> grasps, int fingers) {
  if (grasps.empty()) throw std::invalid_argument("a sequence needs a grasp");
  CandidateSequence sequence;
  sequence.initial = MakeSwitch({}, grasps.front(), fingers).place;
  sequence.rests = {{grasps.front(), std::nullopt}};
  plan::FingerGrasp holding = sequence.initial;
  for (const grasp::Grasp& grasp : grasps.subspan(1)) {
    plan::Switch step = MakeSwitch(holding, grasp, fingers);
    if (step.place.empty() && step.release.empty()) continue;
    holding = plan::GraspAfter(holding, step);
    sequence.steps.emplace_back(std::move(step));
    sequence.rests.push_back({grasp, std::nullopt});
  }
  return sequence;
}

std::optional<plan::PlanObstacle> FindObstacle(const CandidateSequence& candidate,
                                               const criteria::GraspEvaluator& evaluator) {
  return plan::FindPlanObstacle(evaluator.object(), candidate.initial, candidate.steps,
                                evaluator.finger_radius());
}

PlanResult ResultOf(const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator,
                    const std::string& planner, const PlanRequest& request,
                    const grasp::Grasp& goal) {
  PlanResult result;
  if (const auto obstacle = FindObstacle(candidate, evaluator)) {
    result.status = PlanResult::Status::kNoSequence;
    result.message = "planner " + planner + ": no sequence for fingers of radius " +
                     FormatShort(evaluator.finger_radius()) + "; in the best sequence, step " +
                     std::to_string(obstacle->index) + ": " + obstacle->detail;
    return result;
  }
  plan::Plan& plan = result.plan.emplace();
  plan.dimension = request.object->dimension();
  plan.half_angle = request.criteria.half_angle;
  plan.fingers = request.hand.fingers;
  plan.torsion = request.hand.torsion;
  plan.planner = planner;
  if (request.hand.fingertip_radius > 0) plan.finger_radius = request.hand.fingertip_radius;
  plan.initial = candidate.initial;
  plan.steps = candidate.steps;
  plan.goal = goal;
  result.margin = SmallestMargin(candidate.rests, evaluator);
  result.warnings = RestWarnings(candidate.rests, evaluator);
  return result;
}

PlanResult PlanToRandomGoal(const std::function<PlanResult(bool last)>& plan) {
  std::optional<PlanResult> first;
  for (int draw = 1; draw <= kGoalDraws; ++draw) {
    try {
      PlanResult result = plan(draw == kGoalDraws);
      if (result.plan && result.warnings.empty()) return result;
      if (!first) first = std::move(result);
    } catch (const TimeUp&) {
      if (!first) throw;
      break;
    }
  }
  return *first;
}

}  // namespace regrasp::planning
