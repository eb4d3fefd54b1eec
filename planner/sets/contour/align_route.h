#pragma once

#include <vector>

#include "planner/sets/contour/set_geometry.h"

namespace regrasp::contour {

/// The path of an align inside a set, both ends included: straight in contact space inside one
/// piece, and where a contact goes around a vertex of the polygon two grasps that differ in the
/// piece and have the same contact points, before the vertex and after it.
///
/// The path keeps away from the border of the set: of all paths those are admitted whose narrowest
/// passage, by how far the line through the contacts is inside the friction cones, is at least half
/// as wide as that of the widest path. Among these the shortest is taken (Dijkstra 1959), lengths
/// counted over that margin, and then pulled straight inside the middle part of each passage.
/// @param from, to  of the same set.
[[nodiscard]] std::vector<PlacedGrasp> FindAlignRoute(SetGeometry& geometry,
                                                      const PlacedGrasp& from,
                                                      const PlacedGrasp& to);

}  // namespace regrasp::contour
