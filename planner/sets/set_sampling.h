#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/search/switching_graph.h"
#include "planner/sets/set_graph.h"

namespace regrasp::sets {

/// Lists of sets from which a random grasp is drawn, in this order.
using SamplingPools = std::vector<std::vector<SetIndex>>;

/// Draw a standard normal deviate from two uniform ones (Box and Muller 1958).
///
/// A vector of them has a uniformly distributed direction.
[[nodiscard]] double DrawNormal(RandomStream& random);

/// Return the pools for a start: all sets.
[[nodiscard]] SamplingPools StartPools(int set_count);
/// Return the pools for a goal: first all other sets in the components of the start's sets, then
/// the start's own sets.
[[nodiscard]] SamplingPools GoalPools(const search::Components& components,
                                      const std::set<SetIndex>& start_sets);

/// Draw sets from pools and grasps from sets until a grasp meets the acceptance criteria.
/// @param name  name of the grasp for messages.
/// @param draw  function that returns a random grasp of a set; an empty one if none is found.
/// @throws NoGrasp  if none of many draws meets the criteria.
[[nodiscard]] grasp::Grasp DrawFromSets(const std::string& name, SamplingPools pools,
                                        const std::function<grasp::Grasp(SetIndex set)>& draw,
                                        const criteria::GraspEvaluator& evaluator,
                                        RandomStream& random);

}  // namespace regrasp::sets
