#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

StageResult RemoveCrossings(const object::PolygonSoup& soup) {
  Mesh mesh = MeshOf(soup);
  if (!CGAL::is_closed(mesh)) throw std::runtime_error("it is not closed");
  /// More than this many pairs are no blemishes: shells that pass through each other.
  constexpr std::size_t kMostPairs = 20000;
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(faces(mesh), mesh, std::back_inserter(pairs),
                          CGAL::parameters::maximum_number(kMostPairs));
  if (pairs.size() >= kMostPairs) throw std::runtime_error("too many facets meet each other");
  if (!pmp::experimental::remove_self_intersections(mesh,
                                                    CGAL::parameters::preserve_genus(false))) {
    throw std::runtime_error("not all facets that meet each other can be parted");
  }
  mesh.collect_garbage();
  StageResult result{SoupOf(mesh)};
  result.facts["crossing_pairs"] = pairs.size();
  return result;
}

}  // namespace regrasp::repair
