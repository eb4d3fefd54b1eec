// What `--planner auto` takes: the one place where that is decided.

#include <algorithm>

#include "planner/base/error.h"
#include "planner/registry/registry.h"

namespace regrasp::registry {

namespace {

const planning::Planner* FirstThatServes(const planning::PlanRequest& request) {
  const auto found = std::ranges::find_if(AllPlanners(), [&](const planning::Planner* planner) {
    return planning::WhyNotServed(*planner, request).empty();
  });
  return found == AllPlanners().end() ? nullptr : *found;
}

/// Which planners have an option of a request, for objects of its dimension.
std::string ThoseThatHave(planning::PlanOption option, const planning::PlanRequest& request) {
  std::string names;
  for (const planning::Planner* planner : AllPlanners()) {
    if (!planner->ScopeIn(request.object->dimension())) continue;
    const auto& options = planner->traits().options;
    if (std::ranges::find(options, option) == options.end()) continue;
    names += (names.empty() ? "" : ", ") + planner->name();
  }
  return names.empty() ? "no planner" : names;
}

}  // namespace

const planning::Planner& ChoosePlanner(const planning::PlanRequest& request) {
  if (const planning::Planner* planner = FirstThatServes(request)) return *planner;
  std::string why = "no planner has all of";
  const std::string object = request.object->dimension() == 2 ? "a planar object" : "a solid";
  for (const planning::PlanOption option : planning::OptionsOf(request)) {
    why += " " + planning::OptionName(option) + " (" + ThoseThatHave(option, request) + ")";
  }
  throw InputError(why + " for " + object);
}

const planning::Planner& PlannerFor(const std::string& name, const planning::PlanRequest& request) {
  if (name == "auto") return ChoosePlanner(request);
  const planning::Planner* planner = FindPlanner(name);
  if (planner == nullptr) {
    throw InputError("the planner \"" + name + "\" does not exist in this version; there are " +
                     PlannerNames());
  }
  const std::string why = planning::WhyNotServed(*planner, request);
  if (why.empty()) return *planner;
  const planning::Planner* other = FirstThatServes(request);
  throw InputError(why + (other == nullptr ? "" : "; use --planner " + other->name()));
}

}  // namespace regrasp::registry
