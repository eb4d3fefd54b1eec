#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/sets/contour/set_geometry.h"
#include "planner/sets/grasp_set_model.h"

namespace regrasp::contour {

/// Finger switch: two grasps of two sets with a common contact.
using ContourSwitch = sets::SetSwitch<PlacedGrasp>;

/// Score of a static grasp; higher is better.
using PlacedScore = std::function<double(const PlacedGrasp&)>;

/// Find a switch between two sets with both grasps well inside (Phoka 2010, section 4.6.1).
///
/// Candidates are the middle and two more places of the common range of two pieces on an edge. The
/// one with the best smaller score is returned; nullopt if doubles find no common place.
[[nodiscard]] std::optional<ContourSwitch> FindMaxMarginSwitch(SetGeometry& geometry,
                                                               sets::SetIndex from,
                                                               sets::SetIndex to,
                                                               const PlacedScore& score);

/// Find the best grasp of a set that shares a contact with a given grasp.
[[nodiscard]] std::optional<PlacedGrasp> FindGraspKeeping(SetGeometry& geometry,
                                                          const PlacedGrasp& given,
                                                          sets::SetIndex set,
                                                          const PlacedScore& score);

[[nodiscard]] bool HaveCommonContact(const ContourGraph& graph, const PlacedGrasp& a,
                                     const PlacedGrasp& b);

/// Find the switch between two sets with the largest contact regions (Phoka 2010, section 4.6.2).
///
/// It maximizes the smaller half-width of the largest squares about its two grasps. For a fixed
/// shared contact, each square is centred on an edge of its set's diagram. Over each pair of such
/// edges, the smaller half-width is the minimum of two linear functions. The larger half-width
/// breaks ties.
/// @param accepts  predicate of admissible switches. The result is the best accepted one among the
///     best switches of all pairs of edges; if none of many is accepted, the best one.
[[nodiscard]] std::optional<ContourSwitch> FindLargestSwitch(
    SetGeometry& geometry, sets::SetIndex from, sets::SetIndex to,
    const std::function<bool(const ContourSwitch&)>& accepts = [](const ContourSwitch&) {
      return true;
    });

}  // namespace regrasp::contour
