#include "planner/object/surface_mesh.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>

namespace regrasp::object {

SurfaceMesh MakeSurfaceMesh(const TriangleMesh& mesh,
                            const std::vector<std::array<int, 3>>& triangles) {
  std::vector<SurfaceKernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> facets;
  std::vector<int> index(mesh.vertices.size(), -1);
  for (const auto& triangle : triangles) {
    auto& facet = facets.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const int v = triangle[k];
      if (index[v] < 0) {
        index[v] = static_cast<int>(points.size());
        points.emplace_back(mesh.vertices[v].x(), mesh.vertices[v].y(), mesh.vertices[v].z());
      }
      facet[k] = static_cast<std::size_t>(index[v]);
    }
  }
  SurfaceMesh surface;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, facets, surface);
  return surface;
}

}  // namespace regrasp::object
