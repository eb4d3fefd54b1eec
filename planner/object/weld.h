#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::object {

/// A soup in which equal coordinates are one vertex and every vertex is used. Facets are the
/// file's, in its order; what is dropped has no corners.
struct WeldedSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<int> vertex_in_file;  ///< index of the first of the file's vertices there
  std::vector<std::vector<int>> facets;
};

/// Merges vertices whose coordinates are exactly equal (STL lists each several times, OBJ and PLY
/// exporters split them along seams) and drops those that no facet uses.
///
/// A corner that repeats the one before it is dropped, and with it a facet of which fewer than
/// three corners are left: it has no area.
/// @throws MeshError  no facet, too many; an index out of range; a coordinate that is not finite or
///                    beyond kMaxCoordinate.
[[nodiscard]] WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name);

/// Drops corners that repeat the one before them, and all where fewer than three are left.
void DropRepeated(std::vector<int>& corners);

/// Drops the vertices that no facet uses; the others keep their order.
void DropUnused(WeldedSoup& soup);

}  // namespace regrasp::object
