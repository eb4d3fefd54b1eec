#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

StageResult TakePart(const object::PolygonSoup& soup, int part) {
  std::vector<Mesh> solids, cavities;
  for (Mesh& shell : PartsOf(MeshOf(soup))) {
    (VolumeOf(shell) > 0 ? solids : cavities).push_back(std::move(shell));
  }
  std::ranges::stable_sort(solids, std::ranges::greater(), VolumeOf);
  StageResult result;
  Json& shares = result.facts["volume_shares"] = Json::array();
  const double all =
      std::transform_reduce(solids.begin(), solids.end(), 0.0, std::plus(), VolumeOf);
  for (const Mesh& solid : solids) shares.push_back(VolumeOf(solid) / all);
  if (part > std::ssize(solids)) {
    throw std::runtime_error("it has no part " + std::to_string(part) + " but " +
                             std::to_string(solids.size()));
  }
  Mesh taken = solids[part - 1];
  for (const Mesh& cavity : cavities) {
    if (IsInside(cavity, solids[part - 1])) CGAL::copy_face_graph(cavity, taken);
  }
  result.facts["taken"] = part;
  result.soup = SoupOf(taken);
  return result;
}

}  // namespace regrasp::repair
