#pragma once

#include <vector>

#include "planner/contour/set_geometry.h"

namespace regrasp {

/// The way of an align inside a set, both ends included: straight in contact space inside one
/// piece, and where a contact goes around a vertex of the polygon two grasps that differ in the
/// piece and have the same contact points, before the vertex and after it.
///
/// Among the passages from piece to piece a shortest way is taken (Dijkstra 1959), lengths counted
/// more where the border of the set is near: over the half-width of the largest centred square. It
/// is then pulled straight inside the middle part of each passage.
/// @param from, to  of the same set.
[[nodiscard]] std::vector<PlacedGrasp> FindAlignRoute(SetGeometry& geometry,
                                                      const PlacedGrasp& from,
                                                      const PlacedGrasp& to);

}  // namespace regrasp
