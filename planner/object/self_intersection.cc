#include "planner/object/self_intersection.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <iterator>
#include <utility>

#include "planner/object/mesh_defect.h"
#include "planner/object/surface_mesh.h"

namespace regrasp {

void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name) {
  const SurfaceMesh surface = MakeSurfaceMesh(mesh, mesh.triangles);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
  // The first pair is enough; all pairs of a hostile mesh would not fit into memory.
  CGAL::Polygon_mesh_processing::self_intersections(
      faces(surface), surface, std::back_inserter(found), CGAL::parameters::maximum_number(1));
  if (found.empty()) return;
  const auto [a, b] =
      std::minmax(static_cast<int>(found[0].first), static_cast<int>(found[0].second));
  throw MeshError(MeshDefect::kSelfIntersecting,
                  name + ": " + FacetName(mesh, a) + ": self-intersecting: meets " +
                      FacetName(mesh, b) + ", which is not its neighbour there");
}

}  // namespace regrasp
