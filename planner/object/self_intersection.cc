#include "planner/object/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "planner/object/mesh_defect.h"
#include "planner/object/weld.h"

namespace regrasp::object {

namespace {

using IntersectionKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CornerPoint = IntersectionKernel::Point_3;
using Corners = std::array<int, 3>;

/// Number of pairs between two checks of the deadline, about a millisecond.
constexpr std::size_t kPairsBetweenChecks = 5000;

/// Exception that ends the traversal of boxes, which has no other exit.
struct Stop {};

/// Reorder two triangles so that their common corners are first, in the same order.
/// @returns number of common corners.
int SortShared(Corners& a, Corners& b) {
  int shared = 0;
  for (int i = shared; i < 3; ++i) {
    const auto same = std::find(b.begin() + shared, b.end(), a[i]);
    if (same == b.end()) continue;
    std::swap(a[i], a[shared]);
    std::swap(*same, b[shared]);
    ++shared;
  }
  return shared;
}

bool Meet(const TriangleMesh& mesh, Corners a, Corners b) {
  const auto point = [&](int v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    return CornerPoint(p.x(), p.y(), p.z());
  };
  const int shared = SortShared(a, b);
  if (shared == 3) return true;
  const CornerPoint p = point(a[0]), q = point(a[1]), r = point(a[2]);
  if (shared == 2) {  // they meet only if folded onto each other
    const CornerPoint s = point(b[2]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }
  const CornerPoint u = point(b[0]), v = point(b[1]), w = point(b[2]);
  const IntersectionKernel::Triangle_3 first(p, q, r), second(u, v, w);
  if (shared == 0) return CGAL::do_intersect(first, second);
  // If they meet outside the common vertex, the opposite edge of one ends in the other.
  return CGAL::do_intersect(first, IntersectionKernel::Segment_3(v, w)) ||
         CGAL::do_intersect(second, IntersectionKernel::Segment_3(q, r));
}

}  // namespace

bool VisitCrossings(const TriangleMesh& mesh, std::size_t most_pairs, const Deadline& deadline,
                    const std::function<bool(TriangleIndex, TriangleIndex)>& visit) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (int t = 0; t < std::ssize(mesh.triangles); ++t) {
    CGAL::Bbox_3 box;
    for (const int v : mesh.triangles[t]) {
      const Eigen::Vector3d& p = mesh.vertices[v];
      box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(box, t);
  }
  deadline.Check();
  std::size_t pairs = 0;
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      if (++pairs % kPairsBetweenChecks == 0) deadline.Check();
      if (pairs > most_pairs) throw Stop();
      if (!Meet(mesh, mesh.triangles[a.info()], mesh.triangles[b.info()])) return;
      const auto [first, second] = std::minmax({a.info(), b.info()});
      if (!visit(TriangleIndex(first), TriangleIndex(second))) throw Stop();
    });
  } catch (const Stop&) {
  }
  return pairs <= most_pairs;
}

void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name,
                           const Deadline& deadline) {
  const auto reject = [&](TriangleIndex a, TriangleIndex b) -> bool {
    throw MeshError(MeshDefect::kSelfIntersecting,
                    name + ": " + FacetName(mesh, a) + ": self-intersecting: meets " +
                        FacetName(mesh, b) + ", which is not its neighbour there");
  };
  if (VisitCrossings(mesh, kMaxOverlaps, deadline, reject)) return;
  throw MeshError(
      MeshDefect::kTooLarge,
      name + ": too many nearby pairs of facets, expected at most " + std::to_string(kMaxOverlaps));
}

}  // namespace regrasp::object
