#include "planner/planning/rest_summary.h"

#include <algorithm>
#include <utility>

#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/grasp/unit_contacts.h"

namespace regrasp::planning {

double SmallestMargin(const std::vector<Rest>& rests, const criteria::GraspEvaluator& evaluator) {
  // These are lower bounds, so that only the few smallest ones are needed exactly.
  std::vector<std::pair<double, const Rest*>> by_margin;
  for (const Rest& rest : rests)
    by_margin.emplace_back(evaluator.Margin(rest.grasp).value_or(-1), &rest);
  std::ranges::sort(by_margin);
  double smallest = evaluator.half_angle();
  for (const auto& [margin, rest] : by_margin) {
    if (margin >= std::max(smallest, 0.0)) break;
    const grasp::SoftContacts felt(rest->grasp, evaluator.torsion());
    const auto required = grasp::ComputeRequiredHalfAngle(felt.view(), evaluator.frame());
    smallest = std::min(smallest, required ? evaluator.half_angle() - required->upper : 0);
  }
  return smallest;
}

std::vector<std::string> RestWarnings(const std::vector<Rest>& rests,
                                      const criteria::GraspEvaluator& evaluator) {
  const auto name = [&](std::size_t step) {
    if (step == 0) return std::string("the start grasp (step 0)");
    return "the grasp after step " + std::to_string(step) + " of " +
           std::to_string(rests.size() - 1);
  };
  std::vector<std::string> warnings;
  std::vector<std::pair<criteria::UnmetCriterion, std::size_t>> weakest;
  for (std::size_t i = 0; i < rests.size(); ++i) {
    const grasp::Grasp& grasp = rests[i].grasp;
    if (evaluator.Margin(grasp)) continue;
    if (warnings.empty() && !evaluator.IsReachable(grasp)) {
      warnings.push_back("no fingertip fits in " + name(i) + ": a contact is in a concave corner");
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

}  // namespace regrasp::planning
