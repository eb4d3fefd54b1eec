#pragma once

#include <Eigen/Core>
#include <vector>

namespace regrasp::object {

/// Vertices and facets as a file gives them, unchecked. A facet is a polygon of vertex indices,
/// counter-clockwise from outside. It may be non-convex, but it has no holes.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
};

}  // namespace regrasp::object
