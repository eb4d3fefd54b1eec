#include "remesh.h"

#include <CGAL/Complex_2_in_triangulation_3.h>
#include <CGAL/IO/facets_in_complex_2_to_triangle_mesh.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/make_surface_mesh.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace regrasp_meshes {

namespace pmp = CGAL::Polygon_mesh_processing;
namespace sms = CGAL::Surface_mesh_simplification;

namespace {

// Parameters of the fine mesh, whose triangles are much smaller than those of any output.
constexpr double kSmallestAngleDeg = 30;  ///< largest angle for which termination is guaranteed
constexpr double kFineRadius = 0.003;     ///< radius of the surface Delaunay balls, m
constexpr double kFineDistance = 0.0002;  ///< distance from the surface, m
constexpr double kFarRadius = 0.2;        ///< radius of a sphere around the whole solid, m

constexpr int kRemeshing = 30;     ///< iterations, more than have a visible effect
constexpr int kHalvings = 40;      ///< bisections of the interval of edge lengths
constexpr double kMinEdge = 1e-3;  ///< m
constexpr double kMaxEdge = 5e-2;

/// Return the mesh with vertices and triangles sorted by coordinates. The mesher's own order
/// depends on memory addresses, and would affect all later results.
Mesh InFixedOrder(const Mesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  std::sort(points.begin(), points.end());
  const auto index = [&](const Kernel::Point_3& p) {
    return static_cast<int>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
  };
  std::vector<std::array<int, 3>> triangles;
  for (const auto f : mesh.faces()) {
    std::array<int, 3> triangle;
    auto corner = triangle.begin();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      *corner++ = index(mesh.point(v));
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  Mesh sorted;
  pmp::polygon_soup_to_polygon_mesh(points, triangles, sorted);
  return sorted;
}

Point ToPoint(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Remesh isotropically with vertices projected onto the true surface. A length of 0 only flips
/// edges and moves vertices.
void Remesh(Mesh& mesh, const Field& field, double edge_length) {
  const auto project = [&](Mesh::Vertex_index v) {
    const Point p = ProjectToSurface(field, ToPoint(mesh.point(v)));
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  pmp::isotropic_remeshing(mesh.faces(), edge_length, mesh,
                           CGAL::parameters::number_of_iterations(kRemeshing)
                               .number_of_relaxation_steps(3)
                               .projection_functor(project));
  mesh.collect_garbage();
}

/// Return the coarsest remeshing found with at least `triangles` triangles.
Mesh RemeshToAtLeast(const Mesh& fine, const Field& field, std::size_t triangles) {
  double low = kMinEdge;
  double high = kMaxEdge;
  Mesh best;
  for (int i = 0; i < kHalvings && best.number_of_faces() != triangles; ++i) {
    const double length = (low + high) / 2;
    Mesh mesh = fine;
    Remesh(mesh, field, length);
    const bool enough = mesh.number_of_faces() >= triangles;
    (enough ? low : high) = length;
    if (enough && (best.is_empty() || mesh.number_of_faces() < best.number_of_faces())) {
      best = std::move(mesh);
    }
  }
  return best;
}

void Check(const Mesh& mesh, std::size_t triangles) {
  if (mesh.number_of_faces() != triangles) throw std::runtime_error("another number of triangles");
  if (!CGAL::is_closed(mesh)) throw std::runtime_error("the mesh is not closed");
  if (pmp::does_self_intersect(mesh)) throw std::runtime_error("the mesh cuts itself");
}

void CentreAtOrigin(Mesh& mesh) {
  const Kernel::Vector_3 away = pmp::centroid(mesh) - CGAL::ORIGIN;
  for (const auto v : mesh.vertices()) mesh.point(v) = mesh.point(v) - away;
}

}  // namespace

Mesh FineMesh(const Body& body) {
  using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
  using Traits = Triangulation::Geom_traits;
  const auto value = [&](const Traits::Point_3& p) -> Traits::FT {
    return body.field({p.x(), p.y(), p.z()});
  };
  CGAL::get_default_random() = CGAL::Random(0);
  Triangulation triangulation;
  CGAL::Complex_2_in_triangulation_3<Triangulation> complex(triangulation);
  const Traits::Point_3 inside(body.inside.x(), body.inside.y(), body.inside.z());
  const CGAL::Implicit_surface_3<Traits, decltype(value)> surface(
      value, Traits::Sphere_3(inside, kFarRadius * kFarRadius));
  const CGAL::Surface_mesh_default_criteria_3<Triangulation> criteria(kSmallestAngleDeg,
                                                                      kFineRadius, kFineDistance);
  CGAL::make_surface_mesh(complex, surface, criteria, CGAL::Manifold_tag());
  Mesh mesh;
  CGAL::facets_in_complex_2_to_triangle_mesh(complex, mesh);
  if (!pmp::is_outward_oriented(mesh)) pmp::reverse_face_orientations(mesh);
  return InFixedOrder(mesh);
}

Mesh CoarseMesh(const Mesh& fine, const Field& field, std::size_t triangles) {
  Mesh mesh = RemeshToAtLeast(fine, field, triangles);
  // A closed triangle mesh has three edges per two triangles.
  sms::edge_collapse(mesh, sms::Count_stop_predicate<Mesh>(triangles * 3 / 2 + 1),
                     CGAL::parameters::get_cost(sms::Edge_length_cost<Mesh>())
                         .get_placement(sms::Midpoint_placement<Mesh>()));
  mesh.collect_garbage();
  Remesh(mesh, field, 0);
  Check(mesh, triangles);
  CentreAtOrigin(mesh);
  return mesh;
}

double SmallestAngle(const Mesh& mesh) {
  double smallest = std::numbers::pi;
  for (const auto h : mesh.halfedges()) {
    const Point at = ToPoint(mesh.point(mesh.target(h)));
    const Point u = ToPoint(mesh.point(mesh.source(h))) - at;
    const Point v = ToPoint(mesh.point(mesh.target(mesh.next(h)))) - at;
    smallest = std::min(smallest, std::acos(u.dot(v) / (u.norm() * v.norm())));
  }
  return smallest;
}

}  // namespace regrasp_meshes
