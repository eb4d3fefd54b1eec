#pragma once

#include <vector>

#include "planner/sets/contour/set_geometry.h"

namespace regrasp::contour {

/// Find the path of a sliding step inside a set, including both ends.
///
/// The path is straight in contact space inside one piece. If a contact passes a vertex of the
/// polygon, the path contains two grasps with the same contact points: one in the piece before the
/// vertex, one in the piece after it.
///
/// The path stays away from the border of the set. The width of a path is that of its narrowest
/// passage: the angle by which the line through the contacts is inside the friction cones.
/// Admissible paths are at least half as wide as the widest path. Among them the shortest one is
/// selected (Dijkstra 1959), with lengths divided by the margin. It is then straightened inside the
/// middle part of each passage.
/// @param from, to  two grasps of one set.
[[nodiscard]] std::vector<PlacedGrasp> FindAlignRoute(SetGeometry& geometry,
                                                      const PlacedGrasp& from,
                                                      const PlacedGrasp& to);

}  // namespace regrasp::contour
