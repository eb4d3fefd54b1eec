#include "planner/repair/unite_shells.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

/// Exact coordinates are required because a chain of unions in rounded coordinates would intersect
/// at earlier cuts.
using ExactMesh = CGAL::Surface_mesh<ExactPoint>;

struct Shell {
  Mesh mesh;
  double volume = 0;
  CGAL::Bbox_3 box;
};

/// Return the shells, largest first and oriented outwards. Cavities, that is inward shells inside
/// another shell, are kept.
std::vector<Shell> ShellsOf(const Mesh& mesh) {
  std::vector<Shell> shells;
  for (Mesh& part : PartsOf(mesh)) {
    if (!CGAL::is_closed(part)) throw std::runtime_error("not all shells are closed");
    if (pmp::does_self_intersect(part)) throw std::runtime_error("a shell intersects itself");
    const double volume = VolumeOf(part);
    const CGAL::Bbox_3 box = pmp::bbox(part);
    shells.push_back({std::move(part), volume, box});
  }
  std::ranges::stable_sort(shells, std::ranges::greater(),
                           [](const Shell& shell) { return std::abs(shell.volume); });
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (shells[i].volume >= 0) continue;
    const bool cavity =
        std::any_of(shells.begin(), shells.begin() + std::ptrdiff_t(i), [&](const Shell& o) {
          return CGAL::do_overlap(shells[i].box, o.box) && IsInside(shells[i].mesh, o.mesh);
        });
    if (cavity) continue;
    pmp::reverse_face_orientations(shells[i].mesh);
    shells[i].volume = -shells[i].volume;
  }
  return shells;
}

ExactMesh Exact(const Mesh& mesh) {
  ExactMesh exact;
  CGAL::copy_face_graph(mesh, exact);
  return exact;
}

Mesh RoundedMesh(const ExactMesh& exact) {
  Mesh mesh;
  std::vector<std::pair<ExactMesh::Vertex_index, Mesh::Vertex_index>> copies;
  CGAL::copy_face_graph(
      exact, mesh, CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(copies)));
  for (const auto& [from, to] : copies) {
    const Eigen::Vector3d p = Rounded(exact.point(from));
    mesh.point(to) = Kernel::Point_3(p.x(), p.y(), p.z());
  }
  return mesh;
}

void Add(ExactMesh& body, const Shell& shell) {
  ExactMesh other = Exact(shell.mesh);
  const bool solid = shell.volume >= 0;
  if (!solid) pmp::reverse_face_orientations(other);
  ExactMesh sum;
  const bool done = solid ? pmp::corefine_and_compute_union(body, other, sum)
                          : pmp::corefine_and_compute_difference(body, other, sum);
  if (!done) throw std::runtime_error("shells cannot be united");
  body = std::move(sum);
}

}  // namespace

StageResult UniteShells(const object::PolygonSoup& soup) {
  const std::vector<Shell> shells = ShellsOf(MeshOf(soup));
  ExactMesh body = Exact(shells[0].mesh);
  for (std::size_t i = 1; i < shells.size(); ++i) Add(body, shells[i]);
  StageResult result{SoupOf(RoundedMesh(body))};
  result.facts["shells"] = shells.size();
  result.facts["cavities"] =
      std::ranges::count_if(shells, [](const Shell& shell) { return shell.volume < 0; });
  return result;
}

}  // namespace regrasp::repair
