#pragma once

#include "planner/planning/candidate_sequence.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// What the hand does along a path: fingers 0, 1, … take the contacts of `start` in its order;
/// aligns that follow each other are one step.
/// @param start  the contacts of the path's start.
[[nodiscard]] planning::CandidateSequence MakeCandidate(const GraspPath& path,
                                                        const grasp::Grasp& start,
                                                        const SearchSpace& space);

/// The travel of all fingers together: along the surface in an align, straight from where one
/// leaves to where one comes in a switch.
[[nodiscard]] double TravelOf(const GraspPath& path, const SearchSpace& space);

}  // namespace regrasp::tree
