#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// A soup in which equal coordinates are one vertex and every vertex is used.
struct WeldedSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;  ///< index of the first of the file's vertices there
  std::vector<std::vector<int>> facets;
};

/// Merges vertices whose coordinates are exactly equal (STL lists each several times, OBJ and PLY
/// exporters split them along seams) and drops those that no facet uses.
///
/// Facets keep their order and count.
/// @throws MeshError  no facet, too many; an index out of range; a coordinate that is not finite or
///                    beyond kMaxCoordinate; a facet with fewer than three corners or one twice.
[[nodiscard]] WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name);

}  // namespace regrasp::object
