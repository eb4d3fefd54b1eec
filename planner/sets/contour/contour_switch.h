#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "planner/sets/contour/set_geometry.h"
#include "planner/sets/grasp_set_model.h"

namespace regrasp::contour {

/// Two grasps of two sets that have a contact in common.
using ContourSwitch = sets::SetSwitch<PlacedGrasp>;

/// How good it is to rest in a grasp, the more the better.
using PlacedScore = std::function<double(const PlacedGrasp&)>;

/// A switch between two sets, where both grasps are well inside (Phoka 2010, section 4.6.1): of the
/// middles, and places towards the borders, of where two pieces project on the same places of an
/// edge, the one with the best worse score. nullopt where doubles know no common place.
[[nodiscard]] std::optional<ContourSwitch> FindMaxMarginSwitch(SetGeometry& geometry,
                                                               sets::SetIndex from,
                                                               sets::SetIndex to,
                                                               const PlacedScore& score);

/// The best grasp of a set that keeps a contact of a given one: a switch from the one to the other.
[[nodiscard]] std::optional<PlacedGrasp> FindGraspKeeping(SetGeometry& geometry,
                                                          const PlacedGrasp& given,
                                                          sets::SetIndex set,
                                                          const PlacedScore& score);

[[nodiscard]] bool HaveCommonContact(const ContourGraph& graph, const PlacedGrasp& a,
                                     const PlacedGrasp& b);

/// The switch between two sets with the largest contact regions (Phoka 2010, section 4.6.2): it
/// maximises the smaller of the half-widths of the largest squares about its two grasps. When the
/// shared contact is held, each square is centred on an edge of its set's diagram; over each pair
/// of such edges the smaller half-width is the lower one of two lines. Among equals the larger of
/// the two half-widths decides.
/// @param accepts  the best switch that it accepts is taken, of the best of every pair of edges;
///                 the best of all where it accepts none of many.
[[nodiscard]] std::optional<ContourSwitch> FindLargestSwitch(
    SetGeometry& geometry, sets::SetIndex from, sets::SetIndex to,
    const std::function<bool(const ContourSwitch&)>& accepts = [](const ContourSwitch&) {
      return true;
    });

}  // namespace regrasp::contour
