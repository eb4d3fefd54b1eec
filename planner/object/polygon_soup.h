#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace regrasp::object {

/// Vertices and facets as a file gives them, unchecked. A facet is a polygon of vertex indices,
/// counter-clockwise from outside. It may be non-convex, but it has no holes.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
  /// Of each facet whether it is no part of what was scanned or drawn: it fills a gap of a repaired
  /// surface. Empty where none is.
  std::vector<bool> invented = {};
  /// Where the file says what its unit of length is: its name, "inches"; vertices are in metres.
  std::string unit = {};
};

}  // namespace regrasp::object
