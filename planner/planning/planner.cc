#include "planner/planning/planner.h"

#include <algorithm>
#include <stdexcept>

#include "planner/base/memory.h"

namespace regrasp::planning {

std::optional<MemoryNeed> Planner::EstimateMemory(const PlanRequest& /*request*/) const {
  return std::nullopt;
}

GraphSummary Planner::SummarizeGraph(const PlanRequest& /*request*/) const {
  throw std::logic_error("the planner " + name() + " has no graph");
}

std::string OptionName(PlanOption option) {
  switch (option) {
    case PlanOption::kMargin:
      return "--optimize margin";
    case PlanOption::kTravel:
      return "--optimize travel";
    case PlanOption::kRegions:
      return "--optimize regions";
    case PlanOption::kUniformSpanning:
      return "--spanning uniform";
    case PlanOption::kContactPoints:
      return "--contacts";
    case PlanOption::kGivenPoints:
      return "--contacts given";
    case PlanOption::kClusters:
      return "--clusters";
    case PlanOption::kNoLastResort:
      return "--no-lazy";
    case PlanOption::kEffort:
      return "--effort";
    case PlanOption::kExplain:
      return "--explain";
    case PlanOption::kHand:
      return "--hand";
    case PlanOption::kSoftFingers:
      return "--contact soft";
    case PlanOption::kFocusPoints:
      return "--sampling";
    case PlanOption::kQueries:
      return "--queries";
  }
  return {};
}

std::vector<PlanOption> OptionsOf(const PlanRequest& request) {
  std::vector<PlanOption> options;
  const auto add = [&](bool asked, PlanOption option) {
    if (asked) options.push_back(option);
  };
  add(request.objective == Objective::kMargin, PlanOption::kMargin);
  add(request.objective == Objective::kTravel, PlanOption::kTravel);
  add(request.objective == Objective::kRegions, PlanOption::kRegions);
  add(request.spanning == Spanning::kUniform, PlanOption::kUniformSpanning);
  add(request.contact_points.has_value(), PlanOption::kContactPoints);
  add(request.given_points != nullptr, PlanOption::kGivenPoints);
  add(request.clusters.has_value(), PlanOption::kClusters);
  add(!request.last_resort, PlanOption::kNoLastResort);
  add(request.effort.has_value(), PlanOption::kEffort);
  add(request.explain, PlanOption::kExplain);
  add(request.in_hand != nullptr, PlanOption::kHand);
  add(request.hand.torsion > 0, PlanOption::kSoftFingers);
  const GraphTasks tasks = request.graph.value_or(GraphTasks());
  add(tasks.focus_points > 0, PlanOption::kFocusPoints);
  add(tasks.queries > 0, PlanOption::kQueries);
  return options;
}

std::string WhyNotServed(const Planner& planner, const PlanRequest& request) {
  const bool planar = request.object->dimension() == 2;
  const auto scope = planner.ScopeIn(request.object->dimension());
  if (!scope) {
    const std::string name = request.object_name.empty() ? "" : request.object_name + ": ";
    return name + "planner " + planner.name() + " supports " +
           (planar ? "solids" : "planar objects") + " only, found " +
           (planar ? "a planar object" : "a solid");
  }
  if (planner.traits().needs_hand && !request.in_hand) {
    return "planner " + planner.name() + " requires a hand (--hand)";
  }
  if (request.graph && !planner.traits().has_graph) {
    return "planner " + planner.name() + ": graph not supported";
  }
  if (planar && request.hand.torsion > 0) {
    return "--contact soft cannot be used with a planar object";
  }
  const std::vector<PlanOption>& has = planner.traits().options;
  for (const PlanOption option : OptionsOf(request)) {
    if (std::ranges::find(has, option) != has.end()) continue;
    return OptionName(option) + ": not supported by planner " + planner.name();
  }
  if (request.hand.fingers != 0 && request.hand.fingers < scope->fingers) {
    return "planner " + planner.name() + " requires a hand with " + std::to_string(scope->fingers) +
           " fingers, found " + std::to_string(request.hand.fingers);
  }
  return {};
}

}  // namespace regrasp::planning
