#include "planner/sets/set_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::sets {

namespace {

/// Limits of the search for a random grasp: draws per set, and sets per pool.
constexpr int kDrawsPerSet = 30;
constexpr std::size_t kMaxSetDraws = 2000;

}  // namespace

double DrawNormal(RandomStream& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.Uniform()));
  return radius * std::cos(2 * std::numbers::pi * random.Uniform());
}

SamplingPools StartPools(int set_count) {
  std::vector<SetIndex> all(set_count);
  std::iota(all.begin(), all.end(), SetIndex(0));
  return {all};
}

SamplingPools GoalPools(const search::Components& components,
                        const std::set<SetIndex>& start_sets) {
  std::set<int> reachable;
  for (const SetIndex set : start_sets) reachable.insert(components.of_vertex[set]);
  std::vector<SetIndex> others;
  for (SetIndex set{0}; set < static_cast<int>(components.of_vertex.size()); ++set) {
    if (reachable.contains(components.of_vertex[set]) && !start_sets.contains(set)) {
      others.push_back(set);
    }
  }
  return {others, {start_sets.begin(), start_sets.end()}};
}

grasp::Grasp DrawFromSets(const std::string& name, SamplingPools pools,
                          const std::function<grasp::Grasp(SetIndex set)>& draw,
                          const criteria::GraspEvaluator& evaluator, RandomStream& random) {
  std::size_t sets = 0;
  for (std::vector<SetIndex>& pool : pools) {
    sets += pool.size();
    const std::size_t draws = std::min(pool.size(), kMaxSetDraws);
    for (std::size_t i = 0; i < draws; ++i) {
      std::swap(pool[i], pool[i + random.Index(pool.size() - i)]);
      for (int k = 0; k < kDrawsPerSet; ++k) {
        grasp::Grasp grasp = draw(pool[i]);
        if (!grasp.empty() && evaluator.IsGood(grasp)) return grasp;
      }
    }
  }
  throw sampling::NoGrasp{name + ": no grasp" + criteria::WithWhatIsAsked(evaluator.criteria()) +
                          " was drawn from " + std::to_string(sets) + " sets of grasps" +
                          (pools.size() > 1 ? " in the start's component" : "")};
}

}  // namespace regrasp::sets
