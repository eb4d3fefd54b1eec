#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "planner/object/body_measures.h"
#include "planner/object/facet_triangulation.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"
#include "planner/repair/surface_distance.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using Point = Kernel::Point_3;

/// Radius of the coarse wrap over that of the final wrap. Its volume includes openings that it
/// cannot enter.
constexpr double kCoarser = 4;

/// Largest number of rounds that move vertices of bad triangles back to the wrap.
constexpr int kMaxPasses = 20;

std::vector<Point> PointsOf(const object::PolygonSoup& soup) {
  std::vector<Point> points;
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  return points;
}

Mesh Wrap(const object::PolygonSoup& soup, double radius, double offset) {
  Mesh mesh;
  CGAL::alpha_wrap_3(PointsOf(soup), soup.facets, radius, offset, mesh);
  mesh.collect_garbage();
  return mesh;
}

Eigen::Vector3d ToVector(const Point& p) { return {p.x(), p.y(), p.z()}; }

using Faces = std::set<Mesh::Face_index>;

/// Return whether a triangle has no reliable normal.
/// Adjacent slivers do not share a normal either, and a planar face of slivers does not bound a
/// solid.
bool IsSliver(const Point& a, const Point& b, const Point& c, double diameter) {
  if (CGAL::collinear(a, b, c)) return true;
  const double double_area = std::sqrt(CGAL::cross_product(b - a, c - a).squared_length());
  const double longest = std::sqrt(std::max(
      {CGAL::squared_distance(a, b), CGAL::squared_distance(b, c), CGAL::squared_distance(c, a)}));
  return double_area / 2 <= object::kSliverThickness * diameter * longest;
}

/// Return the triangles in `faces` that are slivers, intersect each other or have flipped.
/// @param before  normals before vertices were moved.
Faces FindBad(const Faces& faces, const Mesh& mesh, const std::vector<Kernel::Vector_3>& before,
              double diameter) {
  Faces bad;
  for (const auto f : faces) {
    const auto h = mesh.halfedge(f);
    const Point &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
    const auto normal = CGAL::cross_product(b - a, c - a);
    if (IsSliver(a, b, c, diameter) || normal * before[f] <= 0) bad.insert(f);
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(faces, mesh, std::back_inserter(pairs));
  for (const auto& [one, other] : pairs) {
    bad.insert(one);
    bad.insert(other);
  }
  return bad;
}

/// Return `faces` widened by rings of neighbours.
Faces Widened(Faces faces, const Mesh& mesh) {
  constexpr int kRings = 4;
  for (int ring = 0; ring < kRings; ++ring) {
    Faces wider = faces;
    for (const auto f : faces) {
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        for (const auto next : mesh.faces_around_target(mesh.halfedge(v))) wider.insert(next);
      }
    }
    faces = std::move(wider);
  }
  return faces;
}

/// Project the vertices of a wrap onto a surface, unless triangles become bad.
/// @returns number of vertices that stay on the wrap.
int DrawBack(Mesh& mesh, const SurfaceDistance& surface, double diameter) {
  std::vector<Point> wrapped;
  std::vector<Kernel::Vector_3> normals;
  for (const auto v : mesh.vertices()) wrapped.push_back(mesh.point(v));
  for (const auto f : mesh.faces()) normals.push_back(pmp::compute_face_normal(f, mesh));
  for (const auto v : mesh.vertices()) {
    const Eigen::Vector3d p = surface.ClosestPoint(ToVector(wrapped[v]));
    mesh.point(v) = Point(p.x(), p.y(), p.z());
  }
  const Faces all(mesh.faces().begin(), mesh.faces().end());
  std::set<Mesh::Vertex_index> outside;
  // A vertex that returns to the wrap affects only its neighbourhood. All triangles are checked
  // once no bad one remains.
  Faces examined = all;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const Faces bad = FindBad(examined, mesh, normals, diameter);
    if (bad.empty() && examined.size() == all.size()) return static_cast<int>(outside.size());
    for (const auto f : bad) {
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
        mesh.point(v) = wrapped[v];
        outside.insert(v);
      }
    }
    examined = bad.empty() ? all : Widened(bad, mesh);
  }
  for (const auto v : mesh.vertices()) mesh.point(v) = wrapped[v];
  return static_cast<int>(wrapped.size());
}

}  // namespace

StageResult WrapSurface(const object::PolygonSoup& soup) {
  const double diameter = object::ComputeDiameter(soup.vertices);
  const double radius = kWrapDetail * diameter;
  StageResult result;
  const Mesh coarse = Wrap(soup, kCoarser * radius, kWrapOffset * radius);
  Mesh mesh = Wrap(soup, radius, kWrapOffset * radius);
  result.facts["volumes"] = {{{"radius", kCoarser * radius}, {"volume", VolumeOf(coarse)}},
                             {{"radius", radius}, {"volume", VolumeOf(mesh)}}};
  result.facts["vertices"] = mesh.num_vertices();
  result.facts["vertices_outside"] = DrawBack(mesh, SurfaceDistance(soup), diameter);
  result.soup = SoupOf(mesh);
  return result;
}

StageResult Solidify(const object::PolygonSoup& soup, double thickness) {
  /// Radius of the wrapping sphere over the thickness; it smooths the surface of a sheet.
  constexpr double kBall = 1;
  StageResult result{SoupOf(Wrap(soup, kBall * thickness, thickness / 2))};
  result.facts["thickness"] = thickness;
  return result;
}

}  // namespace regrasp::repair
