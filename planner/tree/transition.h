#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// How a grasp gets to a place at which a finger can be switched.
struct Transition {
  /// Grasps of the first tuple of faces, each a little apart from the one before, all of them
  /// admitted, and contact by contact in the same order. The first is where the search began.
  std::vector<grasp::Grasp> path;
  /// What the last of them is switched to: one of its contacts has left, another one is placed.
  grasp::Grasp after;
};

/// Looks for a switch of one finger between two tuples of faces, where hardly any grasp of the
/// first tuple allows one: all contacts, the one that is to be placed included, move together on
/// their faces at random, and every move that lowers the half-angle that the later grasp requires
/// is kept, as long as the earlier grasp is admitted, until the later one is admitted too. Where a
/// quality is asked for, the half-angle is lowered below the space's own as well.
///
/// @param before   a grasp that the space admits.
/// @param leaving  the place in it of the contact that leaves.
/// @param placed   the contact that comes, to begin with.
/// @returns nullopt where the moves came to nothing: no proof that there is no such switch.
[[nodiscard]] std::optional<Transition> FindTransition(const grasp::Grasp& before, int leaving,
                                                       const grasp::Contact& placed,
                                                       const sampling::SurfaceSampler& source,
                                                       RandomStream& random, SearchSpace& space);

}  // namespace regrasp::tree
