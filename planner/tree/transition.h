#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// Motion of a grasp to a position at which a finger switch is possible.
struct Transition {
  /// Grasps of the first tuple of faces, each slightly different from the previous one, all
  /// admitted, with contacts in the same order. The first is the start of the search.
  std::vector<grasp::Grasp> path;
  /// Grasp after the switch from the last of them: one contact is released, another is placed.
  grasp::Grasp after;
};

/// Search for a switch of one finger between two tuples of faces that few grasps allow.
/// All contacts, including the one to be placed, move together on their faces at random. A move is
/// kept if it lowers the required friction angle of the later grasp and the earlier grasp stays
/// admitted, until the later grasp is admitted too. If a quality is required, the angle may
/// decrease below the space's friction angle.
///
/// @param before   grasp that the space admits.
/// @param leaving  index in `before` of the contact that is released.
/// @param placed   initial position of the contact that is placed.
/// @returns the transition; nullopt if the search fails, which does not prove that there is none.
[[nodiscard]] std::optional<Transition> FindTransition(const grasp::Grasp& before, int leaving,
                                                       const grasp::Contact& placed,
                                                       const sampling::SurfaceSampler& source,
                                                       RandomStream& random, SearchSpace& space);

}  // namespace regrasp::tree
