#include "planner/object/self_intersection.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/box_intersection_d.h>

#include <iterator>
#include <utility>

#include "planner/object/mesh_defect.h"
#include "planner/object/size_limits.h"
#include "planner/object/surface_mesh.h"

namespace regrasp::object {

namespace {

/// The clock is looked at once in about a millisecond.
constexpr std::size_t kOverlapsBetweenLooks = 5000;

/// Throws where the check below would meet more pairs of boxes than it can finish.
void CheckOverlaps(const TriangleMesh& mesh, const std::string& name, const Deadline& deadline) {
  using Box = CGAL::Box_intersection_d::Box_d<double, 3>;
  std::vector<Box> boxes;
  for (const auto& triangle : mesh.triangles) {
    CGAL::Bbox_3 box;
    for (const int v : triangle) {
      const Eigen::Vector3d& p = mesh.vertices[v];
      box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(box);
  }
  std::size_t overlaps = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box&, const Box&) {
    if (++overlaps % kOverlapsBetweenLooks == 0) deadline.Check();
    if (overlaps <= kMaxOverlaps) return;
    throw MeshError(MeshDefect::kTooLarge,
                    name + ": more than " + std::to_string(kMaxOverlaps) +
                        " pairs of facets lie so close that they would have to be checked");
  });
}

}  // namespace

void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name,
                           const Deadline& deadline) {
  CheckOverlaps(mesh, name, deadline);
  deadline.Check();
  const SurfaceMesh surface = MakeSurfaceMesh(mesh, mesh.triangles);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> found;
  deadline.Check();
  // The first pair is enough; all pairs of a hostile mesh would not fit into memory.
  CGAL::Polygon_mesh_processing::self_intersections(
      faces(surface), surface, std::back_inserter(found), CGAL::parameters::maximum_number(1));
  if (found.empty()) return;
  const auto [a, b] = std::minmax({int(found[0].first), int(found[0].second)});
  throw MeshError(MeshDefect::kSelfIntersecting,
                  name + ": " + FacetName(mesh, TriangleIndex(a)) + ": self-intersecting: meets " +
                      FacetName(mesh, TriangleIndex(b)) + ", which is not its neighbour there");
}

}  // namespace regrasp::object
