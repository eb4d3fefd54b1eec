#include "planner/planning/planner.h"

#include <algorithm>
#include <stdexcept>

#include "planner/base/memory.h"

namespace regrasp::planning {

std::optional<MemoryNeed> Planner::EstimateMemory(const PlanRequest& /*request*/) const {
  return std::nullopt;
}

GraphSummary Planner::SummarizeGraph(const PlanRequest& /*request*/) const {
  throw std::logic_error("planner " + name() + ": graph not supported");
}

std::vector<std::string> OptionsOf(const PlanRequest& request) {
  std::vector<std::string> options;
  if (request.objective == Objective::kMargin) options.emplace_back(kMarginOption);
  if (request.objective == Objective::kTravel) options.emplace_back(kTravelOption);
  if (request.objective == Objective::kRegions) options.emplace_back(kRegionsOption);
  for (std::string& option : request.parameters.OptionNames()) options.push_back(std::move(option));
  if (request.given_points != nullptr) options.emplace_back(kGivenPointsOption);
  if (request.hand.torsion > 0) options.emplace_back(kSoftFingersOption);
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
  const std::vector<std::string> requested = OptionsOf(request);
  if (planner.traits().needs_hand && std::ranges::find(requested, kHandOption) == requested.end()) {
    return "planner " + planner.name() + " requires a hand (--hand)";
  }
  if (request.for_graph && !planner.traits().has_graph) {
    return "planner " + planner.name() + ": graph not supported";
  }
  if (planar && request.hand.torsion > 0) {
    return "--torsion: cannot be used with a planar object";
  }
  const std::vector<std::string>& has = planner.traits().options;
  for (const std::string& option : requested) {
    if (std::ranges::find(has, option) != has.end()) continue;
    return option + ": not supported by planner " + planner.name();
  }
  if (request.hand.fingers != 0 && request.hand.fingers < scope->fingers) {
    return "planner " + planner.name() + " requires a hand with " + std::to_string(scope->fingers) +
           " fingers, found " + std::to_string(request.hand.fingers);
  }
  return {};
}

}  // namespace regrasp::planning
