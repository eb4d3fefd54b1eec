#pragma once

#include <optional>
#include <vector>

#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"
#include "planner/tree/subset_graph.h"

namespace regrasp::tree {

/// Joins two grasps over grasps of a few contacts, with the fewest steps: a breadth-first search
/// from both ends, by steps of a SubsetGraph, in which a subset is tested when it is first reached.
///
/// Laws: none of the sets but the ends needs to be admitted; the fewest steps never grow with more
/// contacts, more friction or aligns. (With aligns a path found is not always the shortest: those
/// across edges are given up after some that are not proved.)
/// @param contacts   those of the ends included, at most kMostSubsetContacts.
/// @param most_steps the search ends there.
/// @returns nullopt where there is no path.
[[nodiscard]] std::optional<GraspPath> SearchSubsets(const criteria::ContactSet& from,
                                                     const criteria::ContactSet& to,
                                                     const std::vector<int>& contacts,
                                                     UseAligns aligns, int most_steps,
                                                     SearchSpace& space);

/// Of the paths of at most `most_steps` steps one that needs the least friction, to a milliradian:
/// the half-angle at which SearchSubsets finds one is bisected. What is known of a grasp or an
/// align at one angle spares tests at the others, so that all take little more than the first.
/// @param least  no path is looked for that needs less than this half-angle, radians.
/// @returns nullopt where none needs less than the space's half-angle.
[[nodiscard]] std::optional<GraspPath> SearchWidest(const criteria::ContactSet& from,
                                                    const criteria::ContactSet& to,
                                                    const std::vector<int>& contacts,
                                                    UseAligns aligns, int most_steps, double least,
                                                    SearchSpace& space);

/// Over the contacts of the two grasps alone, by switches. With enough friction that joins nearly
/// all pairs.
[[nodiscard]] std::optional<GraspPath> SearchOwnSubsets(const criteria::ContactSet& from,
                                                        const criteria::ContactSet& to,
                                                        SearchSpace& space);

}  // namespace regrasp::tree
