#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// The largest of several closed shells, with its cavities.
struct LargestShell {
  WeldedSoup soup;   ///< polygons of other shells have no corners
  std::string text;  ///< number and volume of the dropped shells, as text
};

/// Find the closed shell of the largest volume, with its cavities.
///
/// Shells that meet at an edge are separated there, so other shells may intersect each other.
/// Cavities are closed shells inside the largest one with the opposite orientation.
/// @returns nullopt if no shell must be dropped, or a part of the surface is open.
[[nodiscard]] std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup);

/// Connected parts of a surface. An edge with more than two polygons does not connect them.
struct SurfaceParts {
  std::vector<int> of_facet;  ///< part of each polygon; −1 if it was dropped
  std::vector<bool> closed;   ///< whether each part, by itself, is closed
  std::vector<std::vector<int>> facets;
};

/// Find the connected parts of a soup.
/// @param sides  edge sides of the soup.
[[nodiscard]] SurfaceParts FindParts(const WeldedSoup& soup, const std::vector<EdgeSide>& sides);

/// Compute the volume that a closed part encloses; negative if it is oriented inward.
/// `facets` lists the polygons of the part.
[[nodiscard]] double VolumeOf(const WeldedSoup& soup, const std::vector<int>& facets);

/// Compute the winding number of a closed part about a point that is not on it.
///
/// It is the sum of the solid angles (Van Oosterom, Strackee 1983) divided by 4π.
/// `facets` lists the polygons of the part.
[[nodiscard]] double WindingNumber(const WeldedSoup& soup, const std::vector<int>& facets,
                                   const Eigen::Vector3d& point);

}  // namespace regrasp::object
