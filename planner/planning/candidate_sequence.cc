#include "planner/planning/candidate_sequence.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::planning {

CandidateSequence StartOf(const grasp::Grasp& grasp) {
  CandidateSequence candidate;
  candidate.initial = plan::FingersInOrder(grasp);
  candidate.grasps = {{grasp, std::nullopt}};
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
  throw std::invalid_argument("the switch requires more fingers than the hand has");
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
  if (grasps.empty()) throw std::invalid_argument("a sequence requires at least one grasp");
  CandidateSequence sequence;
  sequence.initial = MakeSwitch({}, grasps.front(), fingers).place;
  sequence.grasps = {{grasps.front(), std::nullopt}};
  plan::FingerGrasp holding = sequence.initial;
  for (const grasp::Grasp& grasp : grasps.subspan(1)) {
    plan::Switch step = MakeSwitch(holding, grasp, fingers);
    if (step.place.empty() && step.release.empty()) continue;
    holding = plan::GraspAfter(holding, step);
    sequence.steps.emplace_back(std::move(step));
    sequence.grasps.push_back({grasp, std::nullopt});
  }
  return sequence;
}

std::optional<plan::PlanObstacle> FindObstacle(const CandidateSequence& candidate,
                                               const criteria::GraspEvaluator& evaluator) {
  return plan::FindPlanObstacle(evaluator.object(), candidate.initial, candidate.steps,
                                evaluator.finger_radius());
}

double SmallestMargin(const std::vector<StaticGrasp>& grasps,
                      const criteria::GraspEvaluator& evaluator) {
  // These are lower bounds, so that only the few smallest ones must be computed exactly.
  std::vector<std::pair<double, const StaticGrasp*>> by_margin;
  for (const StaticGrasp& candidate : grasps)
    by_margin.emplace_back(evaluator.Margin(candidate.grasp).value_or(-1), &candidate);
  std::ranges::sort(by_margin);
  double smallest = evaluator.friction_angle();
  for (const auto& [margin, candidate] : by_margin) {
    if (margin >= std::max(smallest, 0.0)) break;
    const grasp::SoftContacts felt(candidate->grasp, evaluator.torsion());
    const auto required = grasp::ComputeRequiredFrictionAngle(felt.view(), evaluator.frame());
    smallest = std::min(smallest, required ? evaluator.friction_angle() - required->upper : 0);
  }
  return smallest;
}

std::vector<std::string> GraspWarnings(const std::vector<StaticGrasp>& grasps,
                                       const criteria::GraspEvaluator& evaluator) {
  const auto name = [&](std::size_t step) {
    if (step == 0) return std::string("the start grasp (step 0)");
    return "the grasp after step " + std::to_string(step) + " of " +
           std::to_string(grasps.size() - 1);
  };
  std::vector<std::string> warnings;
  std::vector<std::pair<criteria::UnmetCriterion, std::size_t>> weakest;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const grasp::Grasp& grasp = grasps[i].grasp;
    if (evaluator.Margin(grasp)) continue;
    if (warnings.empty() && !evaluator.IsReachable(grasp)) {
      warnings.push_back(name(i) + ": a contact is in a concave corner, so no fingertip fits");
    }
    const grasp::SoftContacts felt(grasp, evaluator.torsion());
    for (const auto& unmet : FindUnmet(felt.view(), evaluator.frame(), evaluator.criteria())) {
      const auto known = std::ranges::find_if(
          weakest, [&](const auto& other) { return other.first.name == unmet.name; });
      if (known == weakest.end()) {
        weakest.emplace_back(unmet, i);
      } else if (unmet.reached < known->first.reached) {
        *known = {unmet, i};
      }
    }
  }
  for (const auto& [unmet, step] : weakest) {
    const auto [reached, asked] = FormatWithLimit(unmet.reached, unmet.asked, 4);
    warnings.push_back(std::string(unmet.name) + " falls below the required " + asked + ": " +
                       reached + " in " + name(step));
  }
  return warnings;
}

PlanResult ResultOf(const CandidateSequence& candidate, const criteria::GraspEvaluator& evaluator,
                    const std::string& planner, const PlanRequest& request,
                    const grasp::Grasp& goal) {
  PlanResult result;
  if (const auto obstacle = FindObstacle(candidate, evaluator)) {
    result.status = PlanResult::Status::kNoSequence;
    result.message = "planner " + planner + ": no sequence for fingers of radius " +
                     FormatShort(evaluator.finger_radius()) + "; the best sequence fails at step " +
                     std::to_string(obstacle->index) + ": " + obstacle->detail;
    return result;
  }
  plan::Plan& plan = result.plan.emplace();
  plan.dimension = request.object->dimension();
  plan.friction_angle = request.criteria.friction_angle;
  plan.fingers = request.hand.fingers;
  plan.torsion = request.hand.torsion;
  plan.planner = planner;
  if (request.hand.fingertip_radius > 0) plan.finger_radius = request.hand.fingertip_radius;
  plan.initial = candidate.initial;
  plan.steps = candidate.steps;
  plan.goal = goal;
  result.margin = SmallestMargin(candidate.grasps, evaluator);
  result.warnings = GraspWarnings(candidate.grasps, evaluator);
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
