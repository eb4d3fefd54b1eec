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

/// The sets that a random grasp is drawn from, those of the first list first.
using SamplingPools = std::vector<std::vector<SetIndex>>;

/// A normal deviate, of mean 0 and standard deviation 1, of two uniform ones (Box and Muller 1958):
/// several of them make a direction that is drawn evenly.
[[nodiscard]] double DrawNormal(RandomStream& random);

/// All sets, for a start.
[[nodiscard]] SamplingPools StartPools(int set_count);
/// For a goal: those in the components of the start's sets; the start's own where the others have
/// no grasp.
[[nodiscard]] SamplingPools GoalPools(const search::Components& components,
                                      const std::set<SetIndex>& start_sets);

/// Draws sets from pools and grasps from sets until one is good.
/// @param draw  gives a grasp of a set; an empty one where none was found.
/// @param name  how messages call the grasp.
/// @throws NoGrasp  none of many draws is good.
[[nodiscard]] grasp::Grasp DrawFromSets(const std::string& name, SamplingPools pools,
                                        const std::function<grasp::Grasp(SetIndex set)>& draw,
                                        const criteria::GraspEvaluator& evaluator,
                                        RandomStream& random);

}  // namespace regrasp::sets
