#include "planner/object/facet_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

using TriangulationKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = TriangulationKernel::Point_2;
using Point3 = TriangulationKernel::Point_3;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, TriangulationKernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<
    bool, TriangulationKernel, CGAL::Constrained_triangulation_face_base_2<TriangulationKernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    TriangulationKernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

Point3 ToPoint3(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// Compute Newell's normal: the area vector of the polygon, from its first corner.
Vector3d AreaVector(const std::vector<Vector3d>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  }
  return sum / 2;
}

double DistanceFromPlane(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  Vector3d mean = Vector3d::Zero();
  for (const auto& corner : corners) mean += (corner - corners[0]) / double(corners.size());
  double largest = 0;
  for (const auto& corner : corners) {
    largest = std::max(largest, std::abs(normal.dot(corner - corners[0] - mean)));
  }
  return largest;
}

/// Drop the coordinate in which the normal is largest: exact, and counter-clockwise as seen from
/// outside.
std::vector<Point2> Project(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  if (normal[dropped] < 0) std::swap(u, v);
  std::vector<Point2> projected;
  for (const auto& corner : corners) projected.emplace_back(corner[u], corner[v]);
  return projected;
}

/// Return whether the polygon is simple and counter-clockwise.
bool IsOutline(const std::vector<Point2>& corners) {
  return CGAL::is_simple_2(corners.begin(), corners.end()) &&
         CGAL::orientation_2(corners.begin(), corners.end()) == CGAL::COUNTERCLOCKWISE;
}

/// Mark the faces that are connected with the outside without crossing the outline.
void MarkOutside(Cdt& cdt) {
  for (const auto face : cdt.all_face_handles()) face->info() = false;
  std::vector<Cdt::Face_handle> stack{cdt.infinite_face()};
  cdt.infinite_face()->info() = true;
  while (!stack.empty()) {
    const Cdt::Face_handle face = stack.back();
    stack.pop_back();
    for (int side = 0; side < 3; ++side) {
      const Cdt::Face_handle next = face->neighbor(side);
      if (next->info() || face->is_constrained(side)) continue;
      next->info() = true;
      stack.push_back(next);
    }
  }
}

/// Triangulate `outline`, which is simple and counter-clockwise; returns indices of its points.
std::vector<std::array<int, 3>> TriangulateSimple(const std::vector<Point2>& outline) {
  Cdt cdt;
  std::vector<Cdt::Vertex_handle> handles;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    handles.push_back(cdt.insert(outline[i]));
    handles.back()->info() = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < handles.size(); ++i) {
    cdt.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
  }
  MarkOutside(cdt);
  std::vector<std::array<int, 3>> triangles;
  for (const auto face : cdt.finite_face_handles()) {
    if (face->info()) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return triangles;
}

/// Smallest area of a polygon with four or more corners, divided by its squared extent. A smaller
/// one is lost in rounding: its parts cancel, as in a bow tie, so that it has no plane.
constexpr double kAreaRounding = 1e-13;

double ExtentSquared(const std::vector<Vector3d>& corners) {
  double largest = 0;
  for (const auto& corner : corners) {
    largest = std::max(largest, (corner - corners[0]).squaredNorm());
  }
  return largest;
}

}  // namespace

bool AreCollinear(const std::vector<Vector3d>& corners) {
  const Point3 a = ToPoint3(corners[0]), b = ToPoint3(corners[1]);
  return std::all_of(corners.begin() + 2, corners.end(),
                     [&](const Vector3d& c) { return CGAL::collinear(a, b, ToPoint3(c)); });
}

PolygonCut CutPolygon(const std::vector<Vector3d>& corners) {
  if (AreCollinear(corners)) return {{}, 0, MeshDefect::kDegenerateFacet};
  if (corners.size() == 3) return {{{0, 1, 2}}, 0, {}};
  const Vector3d area = AreaVector(corners);
  if (area.norm() <= kAreaRounding * ExtentSquared(corners)) {
    return {{}, 0, MeshDefect::kSelfIntersecting};
  }
  PolygonCut cut;
  cut.off_plane = DistanceFromPlane(corners, area.normalized());
  const std::vector<Point2> outline = Project(corners, area);
  if (IsOutline(outline)) {
    cut.triangles = TriangulateSimple(outline);
  } else {
    cut.defect = MeshDefect::kSelfIntersecting;
  }
  return cut;
}

namespace {

/// Check that a polygon can be part of a solid's surface.
/// @throws MeshError  if it cannot.
void CheckCut(const PolygonCut& cut, double diameter, const std::string& facet) {
  if (cut.off_plane > kBentTolerance * diameter) {
    const auto [off, most] = FormatWithLimit(cut.off_plane / diameter, kBentTolerance, 4);
    throw MeshError(MeshDefect::kNotPlanar, facet + ": not planar: a corner is " +
                                                FormatShort(cut.off_plane) + " off its plane, " +
                                                off + " of the object's diameter (at most " + most +
                                                ")");
  }
  if (!cut.defect) return;
  throw MeshError(*cut.defect,
                  facet + (*cut.defect == MeshDefect::kDegenerateFacet
                               ? ": degenerate: its area is 0"
                               : ": self-intersecting: its outline intersects itself"));
}

}  // namespace

TriangleMesh TriangulateFacets(const WeldedSoup& soup, double diameter, const std::string& name) {
  TriangleMesh mesh{soup.vertices, soup.vertex_in_file, {}, {}, {}, 0};
  std::vector<Vector3d> corners;
  for (int f = 0; f < std::ssize(soup.facets); ++f) {
    const std::vector<int>& facet = soup.facets[f];
    if (facet.empty()) continue;
    corners.clear();
    for (const int v : facet) corners.push_back(soup.vertices[v]);
    const PolygonCut cut = CutPolygon(corners);
    if (cut.defect || cut.off_plane > 0) {
      CheckCut(cut, diameter, name + ": facet " + std::to_string(f));
    }
    const bool bent = cut.off_plane > kPlanarTolerance * diameter;
    for (const auto& [a, b, c] : cut.triangles) {
      mesh.triangles.push_back({facet[a], facet[b], facet[c]});
      mesh.facet_of_triangle.push_back(f);
      mesh.flat_of_triangle.push_back(mesh.flat_count);
      if (bent) ++mesh.flat_count;
    }
    if (!bent) ++mesh.flat_count;
  }
  return mesh;
}

using Eigen::Vector3d;

namespace {

/// Flat element of the file: a polygon, or a triangle of a bent polygon.
struct Facet {
  Vector3d area_vector = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();  ///< outward unit normal
  std::vector<int> neighbors;          ///< elements across its edges
  double longest_edge = 0;
  int across_longest = -1;
  bool sliver = false;
  bool filled = false;
};

std::vector<Facet> CollectFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                 double diameter, const std::vector<bool>& filled) {
  std::vector<Facet> facets(mesh.flat_count);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    Facet& facet = facets[mesh.flat_of_triangle[t]];
    facet.filled = !filled.empty() && filled[mesh.facet_of_triangle[t]];
    facet.area_vector += DoubleAreaVector(mesh, t) / 2;
    for (int k = 0; k < 3; ++k) {
      const int other = mesh.flat_of_triangle[topology.neighbor[t][k]];
      if (other == mesh.flat_of_triangle[t]) continue;
      facet.neighbors.push_back(other);
      const double length =
          (mesh.vertices[mesh.triangles[t][(k + 1) % 3]] - mesh.vertices[mesh.triangles[t][k]])
              .norm();
      if (length > facet.longest_edge) {
        facet.longest_edge = length;
        facet.across_longest = other;
      }
    }
  }
  for (Facet& facet : facets) {
    facet.normal = facet.area_vector.stableNormalized();
    facet.sliver = facet.area_vector.norm() <= kSliverThickness * diameter * facet.longest_edge;
  }
  return facets;
}

/// Return whether the angle is at most kCoplanarAngle. The cosine is too inaccurate near 0.
bool SameDirection(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) > 0 && a.cross(b).norm() <= std::sin(kCoplanarAngle);
}

void Grow(const std::vector<Facet>& facets, int seed, FaceIndex face,
          std::vector<FaceIndex>& face_of) {
  std::vector<int> stack{seed};
  face_of[seed] = face;
  while (!stack.empty()) {
    const int f = stack.back();
    stack.pop_back();
    for (const int next : facets[f].neighbors) {
      if (face_of[next].valid() || facets[next].sliver) continue;
      if (!SameDirection(facets[next].normal, facets[f].normal) ||
          !SameDirection(facets[next].normal, facets[seed].normal) ||
          facets[next].filled != facets[seed].filled) {
        continue;
      }
      face_of[next] = face;
      stack.push_back(next);
    }
  }
}

/// Maximum length of a chain of slivers that is followed.
constexpr int kLongestSliverChain = 64;

/// Follow slivers across their longest edges to an element with a face; invalid if they form a
/// cycle.
FaceIndex FaceBehindSlivers(const std::vector<Facet>& facets, const std::vector<FaceIndex>& face_of,
                            int f) {
  for (int steps = 0; steps < kLongestSliverChain; ++steps) {
    if (face_of[f].valid()) return face_of[f];
    f = facets[f].across_longest;
  }
  return {};
}

std::vector<FaceIndex> JoinFacets(const std::vector<Facet>& facets) {
  std::vector<int> by_area(facets.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::ranges::stable_sort(by_area, std::ranges::greater(),
                           [&](int f) { return facets[f].area_vector.norm(); });
  std::vector<FaceIndex> face_of(facets.size());
  FaceIndex next{0};
  for (const int seed : by_area) {
    if (face_of[seed].valid() || facets[seed].sliver) continue;
    Grow(facets, seed, next, face_of);
    ++next;
  }
  for (const int f : by_area) {
    if (face_of[f].valid()) continue;
    face_of[f] = FaceBehindSlivers(facets, face_of, f);
    if (face_of[f].valid()) continue;
    face_of[f] = next;
    ++next;
  }
  return face_of;
}

/// Number faces in the order of their first elements in the file.
void Renumber(std::vector<FaceIndex>& face_of) {
  std::vector<FaceIndex> renumbered(face_of.size());
  int next = 0;
  for (FaceIndex& face : face_of) {
    if (!renumbered[face].valid()) renumbered[face] = FaceIndex(next++);
    face = renumbered[face];
  }
}

}  // namespace

std::vector<FaceIndex> JoinCoplanarFacets(const TriangleMesh& mesh, const SurfaceTopology& topology,
                                          double diameter, const std::vector<bool>& filled) {
  std::vector<FaceIndex> face_of_facet =
      JoinFacets(CollectFacets(mesh, topology, diameter, filled));
  Renumber(face_of_facet);
  std::vector<FaceIndex> face_of_triangle;
  face_of_triangle.reserve(mesh.triangles.size());
  for (const int facet : mesh.flat_of_triangle) face_of_triangle.push_back(face_of_facet[facet]);
  return face_of_triangle;
}

}  // namespace regrasp::object
