#include "sim/visible_surface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <iterator>
#include <map>

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon2 = CGAL::Polygon_2<Kernel>;

std::vector<Polygon2> Triangulate(const Polygon& polygon) {
  std::vector<Polygon2> rings;
  for (const auto& ring : polygon.rings()) {
    Polygon2& out = rings.emplace_back();
    for (const Eigen::Vector2d& p : ring) out.push_back({p.x(), p.y()});
  }
  const CGAL::Polygon_with_holes_2<Kernel> region(rings.front(), rings.begin() + 1, rings.end());
  std::vector<Polygon2> triangles;
  CGAL::Polygon_triangulation_decomposition_2<Kernel>()(region, std::back_inserter(triangles));
  for (Polygon2& triangle : triangles) {
    if (triangle.is_clockwise_oriented()) triangle.reverse_orientation();
  }
  return triangles;
}

VisibleSurface MakePrism(const Polygon& polygon, double thickness) {
  VisibleSurface prism;
  std::map<Kernel::Point_2, int> index;  // of a corner's lower vertex; the upper one comes next
  for (const auto& ring : polygon.rings()) {
    for (const Eigen::Vector2d& p : ring) {
      index[{p.x(), p.y()}] = static_cast<int>(prism.vertices.size());
      prism.vertices.emplace_back(p.x(), p.y(), -thickness / 2);
      prism.vertices.emplace_back(p.x(), p.y(), thickness / 2);
    }
  }
  for (const Polygon2& triangle : Triangulate(polygon)) {
    const int a = index.at(triangle[0]), b = index.at(triangle[1]), c = index.at(triangle[2]);
    prism.triangles.push_back({a, c, b});
    prism.triangles.push_back({a + 1, b + 1, c + 1});
  }
  for (int face = 0; face < polygon.face_count(); ++face) {
    const auto [from, to] = polygon.edge(face);
    const int a = index.at({from.x(), from.y()}), b = index.at({to.x(), to.y()});
    prism.triangles.push_back({a, b, b + 1});
    prism.triangles.push_back({a, b + 1, a + 1});
  }
  return prism;
}

}  // namespace

VisibleSurface MakeVisibleSurface(const Object& object, double thickness) {
  if (const auto* polygon = dynamic_cast<const Polygon*>(&object)) {
    return MakePrism(*polygon, thickness);
  }
  const auto& body = dynamic_cast<const Polyhedron&>(object);
  return {body.vertices(), body.triangles()};
}

}  // namespace regrasp
