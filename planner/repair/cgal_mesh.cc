#include "planner/repair/cgal_mesh.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

Mesh MeshOf(const object::PolygonSoup& soup) {
  std::vector<Kernel::Point_3> points;
  points.reserve(soup.vertices.size());
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.facets)) {
    throw std::runtime_error("its facets do not form a surface");
  }
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, soup.facets, mesh);
  return mesh;
}

object::PolygonSoup SoupOf(const Mesh& mesh) {
  object::PolygonSoup soup;
  std::vector<int> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    number[v] = static_cast<int>(soup.vertices.size());
    const auto& p = mesh.point(v);
    soup.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::vector<int>& facet = soup.facets.emplace_back();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) facet.push_back(number[v]);
  }
  return soup;
}

std::vector<Mesh> PartsOf(const Mesh& mesh) {
  std::vector<Mesh> parts;
  pmp::split_connected_components(mesh, parts);
  return parts;
}

bool FillHole(Mesh& mesh, Mesh::Halfedge_index border) {
  /// Largest number of border edges for which all triangles are searched, in a few seconds.
  constexpr int kLongBorder = 500;
  const auto edges = CGAL::halfedges_around_face(border, mesh);
  const bool is_long = std::distance(edges.begin(), edges.end()) > kLongBorder;
  std::vector<Mesh::Face_index> patch;
  pmp::triangulate_hole(mesh, border, std::back_inserter(patch),
                        CGAL::parameters::do_not_use_cubic_algorithm(is_long));
  return !patch.empty();
}

double VolumeOf(const Mesh& mesh) { return CGAL::to_double(pmp::volume(mesh)); }

bool IsInside(const Mesh& inner, const Mesh& outer) {
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(outer);
  return std::ranges::all_of(inner.vertices(), [&](const auto v) {
    return side(inner.point(v)) == CGAL::ON_BOUNDED_SIDE;
  });
}

}  // namespace regrasp::repair
