#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// One closed shell of several, with its cavities.
struct LargestShell {
  WeldedSoup soup;   ///< the facets of the others have no corners
  std::string text;  ///< how many were left out, and how large they are
};

/// Finds the closed shell of the largest volume. Shells that meet at an edge are told apart there,
/// so that it does not matter what the others meet. Its cavities are the closed shells inside it
/// that are oriented the other way.
/// @returns nullopt where nothing is to be left out, or a part of the surface is open.
[[nodiscard]] std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup);

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
