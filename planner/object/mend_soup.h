#pragma once

#include <vector>

#include "planner/object/weld.h"

namespace regrasp::object {

/// A facet with the corners of an earlier one, in the same order or in the opposite.
struct RepeatedFacet {
  int facet;
  int first;  ///< the first facet with these corners
  bool same_way;
};

/// Facets that lie on others: those that have the corners of an earlier one, by the earlier one.
/// Facets without corners are none.
/// @param facets  polygons as vertices, none of them twice.
[[nodiscard]] std::vector<RepeatedFacet> FindRepeatedFacets(
    const std::vector<std::vector<int>>& facets);

/// Mends what can be mended in a soup without moving its surface, in this order:
///
/// - open edges are closed by making their ends one where they lie within kPointTolerance · D of
///   each other, at the first of them (other vertices stay where they are);
/// - facets without area are dropped; where one reaches from edge to edge along a line, the edges
///   beside it get its corners;
/// - facets with the same corners: one and another of opposite orientation are both dropped (a wall
///   without thickness), of what is left all but one.
///
/// It is for soups that are no closed manifold: sound ones are not to be changed. What is left may
/// still be none; facets keep their number, those that are dropped have no corners.
/// @param diameter  the object's, D.
/// @returns whether anything was changed.
bool MendSoup(WeldedSoup& soup, double diameter);

}  // namespace regrasp::object
