#include "planner/repair/surface_distance.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace regrasp::repair {

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
  if (tree_->triangles.empty())
    throw std::runtime_error("no facet has an area that can be measured");
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
