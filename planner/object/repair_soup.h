#pragma once

#include <vector>

#include "planner/object/weld.h"

namespace regrasp::object {

/// Polygon with the corners of an earlier one, in the same or the opposite order.
struct RepeatedFacet {
  int facet;
  int first;  ///< first polygon with these corners
  bool same_way;
};

/// Find polygons that have the corners of an earlier one, sorted by the earlier one.
///
/// `facets` lists the vertex indices of each polygon, without repetition. Polygons without corners
/// are ignored.
[[nodiscard]] std::vector<RepeatedFacet> FindRepeatedFacets(
    const std::vector<std::vector<int>>& facets);

/// Fix those defects of a soup that do not require moving its surface.
///
/// The steps, in this order:
///
/// - Close open edges: merge their ends if they are within kPointTolerance · D of each other, at
///   the position of the first. Other vertices do not move.
/// - Drop polygons without area. If one connects several edges along a line, the polygons at these
///   edges get its corners.
/// - Drop repeated polygons. Two with the same corners and opposite orientation form a wall without
///   thickness, and both are dropped. One of the remaining ones with the same corners is kept.
///
/// Call it only for soups that are not closed manifolds; it may change sound ones. The result may
/// still not be a closed manifold. Polygons keep their numbers; dropped ones have no corners.
/// @param diameter  diameter D of the object.
/// @returns whether the soup was changed.
bool RepairSoup(WeldedSoup& soup, double diameter);

}  // namespace regrasp::object
