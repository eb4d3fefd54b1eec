#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

StageResult Simplify(const object::PolygonSoup& soup, int facets) {
  namespace sms = CGAL::Surface_mesh_simplification;
  Mesh mesh = MeshOf(soup);
  // A closed surface of triangles has three edges for two facets.
  sms::edge_collapse(mesh, sms::Count_stop_predicate<Mesh>(std::size_t(facets) * 3 / 2 + 1));
  mesh.collect_garbage();
  StageResult result{SoupOf(mesh)};
  result.facts["facets"] = mesh.num_faces();
  return result;
}

}  // namespace regrasp::repair
