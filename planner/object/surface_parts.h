#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/edge_sides.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// The connected parts of a surface: at an edge with more than two facets nothing is joined.
struct SurfaceParts {
  std::vector<int> of_facet;  ///< −1: the facet is dropped
  std::vector<bool> closed;   ///< the part has no border, by itself
  std::vector<std::vector<int>> facets;
};

/// @param sides  of the soup's edges.
[[nodiscard]] SurfaceParts FindParts(const WeldedSoup& soup, const std::vector<EdgeSide>& sides);

/// What a closed part encloses; negative where it is oriented inward.
/// @param facets  of the part.
[[nodiscard]] double VolumeOf(const WeldedSoup& soup, const std::vector<int>& facets);

/// How often a closed part winds about a point that is not on it: the sum of the solid angles
/// (Van Oosterom, Strackee 1983) over 4π.
[[nodiscard]] double WindingNumber(const WeldedSoup& soup, const std::vector<int>& facets,
                                   const Eigen::Vector3d& point);

}  // namespace regrasp::object
