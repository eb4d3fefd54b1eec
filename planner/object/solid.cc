#include "planner/object/solid.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "planner/object/polygon_soup.h"
#include "planner/object/weld.h"

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

using Eigen::Vector3d;

namespace {

/// Bound on the rounding of a volume, divided by area times extent: 64 units in the last place,
/// because the terms are triangle areas times distances.
constexpr double kVolumeRounding = 64 * 2.3e-16;

struct Shell {
  std::vector<std::array<int, 3>> triangles;
  TriangleIndex first_triangle;  ///< names the shell in messages
  double volume = 0;
  double area = 0;
  CGAL::Bbox_3 box;
};

std::vector<Shell> CollectOrientedShells(const TriangleMesh& mesh,
                                         const SurfaceTopology& topology) {
  std::vector<Shell> shells(topology.shell_count);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Shell& shell = shells[topology.shell[t]];
    if (!shell.first_triangle.valid()) shell.first_triangle = t;
    shell.triangles.push_back(mesh.triangles[t]);
    const Vector3d& from = mesh.vertices[mesh.triangles[shell.first_triangle][0]];
    const Vector3d area = DoubleAreaVector(mesh, t) / 2;
    shell.volume += area.dot(mesh.vertices[mesh.triangles[t][0]] - from) / 3;
    shell.area += area.norm();
    for (const int v : mesh.triangles[t]) {
      const Vector3d& p = mesh.vertices[v];
      shell.box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
  }
  return shells;
}

double Extent(const CGAL::Bbox_3& box) {
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

/// Reverse the orientation of shells.
/// @param turned  for each shell, whether to reverse it.
void Turn(TriangleMesh& mesh, SurfaceTopology& topology, const std::vector<bool>& turned) {
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    if (!turned[topology.shell[t]]) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    // Edges 0→1, 1→2, 2→0 have become 1→0, 2→1, 0→2 and start at corners 2, 1, 0.
    std::swap(topology.neighbor[t][0], topology.neighbor[t][2]);
  }
}

/// Test whether shells are inside one shell. Shells do not touch, so one vertex of another shell
/// decides for all of it.
class Inside {
 public:
  Inside(const TriangleMesh& mesh, const Shell& shell)
      : mesh_(mesh), box_(shell.box), surface_(MakeSurfaceMesh(mesh, shell.triangles)) {
    side_ = std::make_unique<Side>(surface_);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  [[nodiscard]] bool Contains(const Shell& other) const {
    if (!CGAL::do_overlap(box_, other.box)) return false;
    const Vector3d& p = mesh_.vertices[other.triangles[0][0]];
    return (*side_)(SurfaceKernel::Point_3(p.x(), p.y(), p.z())) == CGAL::ON_BOUNDED_SIDE;
  }

 private:
  using Side = CGAL::Side_of_triangle_mesh<SurfaceMesh, SurfaceKernel>;
  const TriangleMesh& mesh_;
  CGAL::Bbox_3 box_;
  SurfaceMesh surface_;
  std::unique_ptr<Side> side_;
};

[[noreturn]] void RejectShell(const TriangleMesh& mesh, const Shell& shell, const std::string& why,
                              const std::string& name) {
  throw MeshError(MeshDefect::kSeveralSolids, name + ": " + FacetName(mesh, shell.first_triangle) +
                                                  ": several solids: its shell " + why);
}

void CheckCavities(const TriangleMesh& mesh, const std::vector<Shell>& shells, std::size_t outside,
                   double orientation, const std::string& name) {
  const Inside in_outside(mesh, shells[outside]);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (s == outside) continue;
    if (!in_outside.Contains(shells[s])) {
      RejectShell(mesh, shells[s], "is not inside the largest shell", name);
    }
    if (orientation * shells[s].volume >= 0) {
      RejectShell(mesh, shells[s], "is inside the largest shell and not oriented as a cavity",
                  name);
    }
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (s == outside) continue;
    const Inside in_cavity(mesh, shells[s]);
    for (std::size_t other = 0; other < shells.size(); ++other) {
      if (other == outside || other == s || !in_cavity.Contains(shells[other])) continue;
      RejectShell(mesh, shells[other], "is inside a cavity", name);
    }
  }
}

/// Relation of the shells to the union of all solids.
struct Union {
  std::vector<bool> turned;    ///< oriented inside out in the file
  std::vector<bool> kept;      ///< part of the boundary of the union
  std::vector<bool> enclosed;  ///< inside another shell
  int solids = 0;              ///< number of kept shells that are not cavities
};

/// Classify the shells of a union.
///
/// Shells do not touch, so the shells around one are nested. Crossing a shell inwards changes the
/// winding number by ±1. There is no material at winding number 0.
Union FindUnion(const TriangleMesh& mesh, const std::vector<Shell>& shells) {
  std::vector<std::size_t> order(shells.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](std::size_t s) { return std::abs(shells[s].volume); });
  std::vector<std::unique_ptr<Inside>> inside;
  for (const Shell& shell : shells) inside.push_back(std::make_unique<Inside>(mesh, shell));
  Union all{std::vector<bool>(shells.size()), std::vector<bool>(shells.size()),
            std::vector<bool>(shells.size())};
  std::vector<int> sign(shells.size());
  for (auto here = order.begin(); here != order.end(); ++here) {
    const std::size_t s = *here;
    int winding = 0;
    for (auto about = order.begin(); about != here; ++about) {
      if (!inside[*about]->Contains(shells[s])) continue;
      all.turned[s] = all.turned[*about];  // finally that of the innermost shell
      all.enclosed[s] = true;
      winding += sign[*about];
    }
    // A shell that is not inside material cannot be a cavity.
    if (winding == 0) all.turned[s] = shells[s].volume < 0;
    sign[s] = (shells[s].volume < 0) == all.turned[s] ? 1 : -1;
    all.kept[s] = (winding > 0) != (winding + sign[s] > 0);
    all.solids += all.kept[s] && sign[s] > 0;
  }
  return all;
}

/// Drop unused vertices; the others keep their order.
void DropUnusedVertices(TriangleMesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    for (const int v : triangle) number[v] = 0;
  }
  int next = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    mesh.vertices[next] = mesh.vertices[v];
    mesh.vertex_in_file[next] = mesh.vertex_in_file[v];
    number[v] = next++;
  }
  mesh.vertices.resize(next);
  mesh.vertex_in_file.resize(next);
  for (auto& triangle : mesh.triangles) {
    for (int& v : triangle) v = number[v];
  }
}

/// Drop the triangles of shells that are not kept.
void Keep(TriangleMesh& mesh, const SurfaceTopology& topology, const std::vector<bool>& kept) {
  const auto keep = [&](auto& of_triangles) {
    std::size_t next = 0;
    for (TriangleIndex t{0}; t < std::ssize(topology.shell); ++t) {
      if (kept[topology.shell[t]]) of_triangles[next++] = of_triangles[t];
    }
    of_triangles.resize(next);
  };
  keep(mesh.triangles);
  keep(mesh.facet_of_triangle);
  keep(mesh.flat_of_triangle);
  DropUnusedVertices(mesh);
}

SolidShells Unite(TriangleMesh& mesh, SurfaceTopology& topology, const std::vector<Shell>& shells,
                  const std::string& name) {
  const Union all = FindUnion(mesh, shells);
  const auto left_out = std::ranges::count(all.kept, false);
  Turn(mesh, topology, all.turned);
  SolidShells result;
  // Kept shells stay in order, so numbers change only by dropped shells.
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (all.kept[s]) result.enclosed.push_back(all.enclosed[s]);
  }
  if (left_out > 0) {
    Keep(mesh, topology, all.kept);
    topology = ComputeTopology(mesh, name);
  }
  if (all.solids == 1 && left_out == 0) return result;
  result.text = std::to_string(shells.size()) + " closed shells form one body of " +
                std::to_string(all.solids) + (all.solids == 1 ? " solid" : " solids");
  if (left_out > 0) {
    result.text += "; " + std::to_string(left_out) + " inside the material, omitted";
  }
  return result;
}

}  // namespace

SolidShells OrientSolid(TriangleMesh& mesh, SurfaceTopology& topology, std::optional<Shells> choice,
                        const std::string& name) {
  const std::vector<Shell> shells = CollectOrientedShells(mesh, topology);
  const auto largest = std::ranges::max_element(
      shells, {}, [](const Shell& shell) { return std::abs(shell.volume); });
  if (std::abs(largest->volume) <= kVolumeRounding * largest->area * Extent(largest->box)) {
    throw MeshError(MeshDefect::kEmpty, name + ": empty: the surface encloses no volume");
  }
  if (choice == Shells::kUnion) return Unite(mesh, topology, shells, name);
  const double orientation = largest->volume > 0 ? 1 : -1;
  const auto outside = largest - shells.begin();
  if (shells.size() > 1) {
    CheckCavities(mesh, shells, static_cast<std::size_t>(outside), orientation, name);
  }
  if (orientation < 0) Turn(mesh, topology, std::vector<bool>(shells.size(), true));
  SolidShells result{std::vector<bool>(shells.size(), true), ""};
  result.enclosed[outside] = false;
  return result;
}

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
