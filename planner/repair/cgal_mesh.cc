#include "planner/repair/cgal_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <vector>

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

Mesh MeshOf(const object::PolygonSoup& soup) {
  std::vector<Kernel::Point_3> points;
  points.reserve(soup.vertices.size());
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.facets)) {
    throw std::runtime_error("the triangles do not form a surface");
  }
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, soup.facets, mesh);
  return mesh;
}

object::PolygonSoup SoupOf(const Mesh& mesh) {
  object::PolygonSoup soup;
  std::vector<int> number(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    number[v] = static_cast<int>(soup.vertices.size());
    const auto& p = mesh.point(v);
    soup.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::vector<int>& facet = soup.facets.emplace_back();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) facet.push_back(number[v]);
  }
  return soup;
}

std::vector<Mesh> PartsOf(const Mesh& mesh) {
  std::vector<Mesh> parts;
  pmp::split_connected_components(mesh, parts);
  return parts;
}

bool FillHole(Mesh& mesh, Mesh::Halfedge_index border) {
  /// Largest number of border edges for which all triangles are searched, in a few seconds.
  constexpr int kLongBorder = 500;
  const auto edges = CGAL::halfedges_around_face(border, mesh);
  const bool is_long = std::distance(edges.begin(), edges.end()) > kLongBorder;
  std::vector<Mesh::Face_index> patch;
  pmp::triangulate_hole(mesh, border, std::back_inserter(patch),
                        CGAL::parameters::do_not_use_cubic_algorithm(is_long));
  return !patch.empty();
}

double VolumeOf(const Mesh& mesh) { return CGAL::to_double(pmp::volume(mesh)); }

bool IsInside(const Mesh& inner, const Mesh& outer) {
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(outer);
  return std::ranges::all_of(inner.vertices(), [&](const auto v) {
    return side(inner.point(v)) == CGAL::ON_BOUNDED_SIDE;
  });
}

namespace {

/// Distances are measurements, not decisions, so doubles suffice.
using Measuring = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Measuring::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Measuring, Triangles::const_iterator>;

Measuring::Point_3 ToPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Measuring::Ray_3 ToRay(const Eigen::Vector3d& p, const Eigen::Vector3d& d) {
  return {ToPoint(p), Measuring::Vector_3(d.x(), d.y(), d.z())};
}

}  // namespace

struct SurfaceDistance::Tree {
  Triangles triangles;
  std::vector<int> facets;  ///< index of each triangle in the soup
  CGAL::AABB_tree<CGAL::AABB_traits<Measuring, Primitive>> tree;
};

SurfaceDistance::SurfaceDistance(const object::PolygonSoup& soup) : tree_(new Tree) {
  for (std::size_t i = 0; i < soup.facets.size(); ++i) {
    const auto& f = soup.facets[i];
    const Measuring::Triangle_3 triangle(ToPoint(soup.vertices[f[0]]), ToPoint(soup.vertices[f[1]]),
                                         ToPoint(soup.vertices[f[2]]));
    // Degenerate triangles lie on their neighbours, and rays cannot be intersected with them.
    if (Measuring().is_degenerate_3_object()(triangle)) continue;
    tree_->triangles.push_back(triangle);
    tree_->facets.push_back(static_cast<int>(i));
  }
  if (tree_->triangles.empty()) throw std::runtime_error("the area of all triangles is 0");
  tree_->tree.rebuild(tree_->triangles.begin(), tree_->triangles.end());
  tree_->tree.accelerate_distance_queries();
}

SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;

SurfaceDistance::Closest SurfaceDistance::FindClosest(const Eigen::Vector3d& point,
                                                      const std::optional<Closest>& near) const {
  const Measuring::Point_3 query = ToPoint(point);
  // The tree's own hint is a corner, which is far away if triangles are long.
  auto hint = tree_->tree.best_hint(query);
  const auto try_hint = [&](Triangles::const_iterator triangle) {
    const Measuring::Point_3 p = Measuring().construct_projected_point_3_object()(*triangle, query);
    if (CGAL::squared_distance(p, query) < CGAL::squared_distance(hint.first, query)) {
      hint = {p, triangle};
    }
  };
  try_hint(hint.second);
  if (near) try_hint(tree_->triangles.cbegin() + near->triangle);
  const auto [p, triangle] = tree_->tree.closest_point_and_primitive(query, hint);
  const auto number = triangle - tree_->triangles.cbegin();
  return {{p.x(), p.y(), p.z()}, tree_->facets[number], static_cast<int>(number)};
}

double SurfaceDistance::DistanceTo(const Eigen::Vector3d& point, const Closest& found) const {
  const Measuring::Point_3 query = ToPoint(point);
  return std::sqrt(CGAL::squared_distance(
      Measuring().construct_projected_point_3_object()(tree_->triangles[found.triangle], query),
      query));
}

bool SurfaceDistance::IsHit(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const {
  return tree_->tree.do_intersect(ToRay(point, direction));
}

double SurfaceDistance::FirstHit(const Eigen::Vector3d& point,
                                 const Eigen::Vector3d& direction) const {
  const auto hit = tree_->tree.first_intersection(ToRay(point, direction));
  if (!hit) return std::numeric_limits<double>::infinity();
  if (const auto* p = boost::get<Measuring::Point_3>(&hit->first)) {
    return (Eigen::Vector3d(p->x(), p->y(), p->z()) - point).norm();
  }
  return 0;  // the ray is in a triangle's plane
}

}  // namespace regrasp::repair
