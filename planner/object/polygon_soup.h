#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace regrasp::object {

/// Unchecked vertices and polygons (`facets`) of a file.
///
/// A polygon lists vertex indices, counter-clockwise from outside. It may be non-convex, but has no
/// holes.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
  /// For each polygon, whether it fills a gap and is not part of the scanned or drawn surface.
  /// Empty if no polygon is.
  std::vector<bool> filled = {};
  /// Name of the unit of length in the file, such as "inches"; empty if the file has none. If set,
  /// vertices are in metres.
  std::string unit = {};
};

}  // namespace regrasp::object
