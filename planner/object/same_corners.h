#pragma once

#include <vector>

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

}  // namespace regrasp::object
