// What `--planner auto` takes: the one place where that is decided.

#include <algorithm>

#include "planner/base/error.h"
#include "planner/registry/registry.h"

namespace regrasp {

namespace {

const Planner* FirstThatServes(const PlanRequest& request) {
  const auto found = std::ranges::find_if(AllPlanners(), [&](const Planner* planner) {
    return WhyNotServed(*planner, request).empty();
  });
  return found == AllPlanners().end() ? nullptr : *found;
}

/// Which planners have an option of a request, for objects of its dimension.
std::string ThoseThatHave(PlanOption option, const PlanRequest& request) {
  std::string names;
  for (const Planner* planner : AllPlanners()) {
    if (!planner->ScopeIn(request.object->dimension())) continue;
    const auto& options = planner->traits().options;
    if (std::ranges::find(options, option) == options.end()) continue;
    names += (names.empty() ? "" : ", ") + planner->name();
  }
  return names.empty() ? "no planner" : names;
}

}  // namespace

const Planner& ChoosePlanner(const PlanRequest& request) {
  if (const Planner* planner = FirstThatServes(request)) return *planner;
  std::string why = "no planner has all of";
  const std::string object = request.object->dimension() == 2 ? "a planar object" : "a solid";
  for (const PlanOption option : OptionsOf(request)) {
    why += " " + OptionName(option) + " (" + ThoseThatHave(option, request) + ")";
  }
  throw InputError(why + " for " + object);
}

const Planner& PlannerFor(const std::string& name, const PlanRequest& request) {
  if (name == "auto") return ChoosePlanner(request);
  const Planner* planner = FindPlanner(name);
  if (planner == nullptr) {
    throw InputError("the planner \"" + name + "\" does not exist in this version; there are " +
                     PlannerNames());
  }
  const std::string why = WhyNotServed(*planner, request);
  if (why.empty()) return *planner;
  const Planner* other = FirstThatServes(request);
  throw InputError(why + (other == nullptr ? "" : "; use --planner " + other->name()));
}

}  // namespace regrasp
