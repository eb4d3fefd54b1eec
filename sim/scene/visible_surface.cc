#include "sim/scene/visible_surface.h"

#include "planner/object/polygon.h"
#include "planner/object/polygon_triangulation.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sim {
namespace {

VisibleSurface MakePrism(const object::Polygon& polygon, double thickness) {
  VisibleSurface prism;
  // Vertex k of the polygon is 2 k below and 2 k + 1 above.
  for (const auto& ring : polygon.rings()) {
    const int first = static_cast<int>(prism.vertices.size());
    const int count = static_cast<int>(ring.size());
    for (int k = 0; k < count; ++k) {
      prism.vertices.emplace_back(ring[k].x(), ring[k].y(), -thickness / 2);
      prism.vertices.emplace_back(ring[k].x(), ring[k].y(), thickness / 2);
      const int a = first + 2 * k;
      const int b = first + 2 * ((k + 1) % count);
      prism.triangles.push_back({a, b, b + 1});
      prism.triangles.push_back({a, b + 1, a + 1});
    }
  }
  for (const auto& [a, b, c] : object::TriangulatePolygon(polygon)) {
    prism.triangles.push_back({2 * a, 2 * c, 2 * b});
    prism.triangles.push_back({2 * a + 1, 2 * b + 1, 2 * c + 1});
  }
  return prism;
}

}  // namespace

VisibleSurface MakeVisibleSurface(const object::Object& object, double thickness) {
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&object)) {
    return MakePrism(*polygon, thickness);
  }
  const auto& body = dynamic_cast<const object::Polyhedron&>(object);
  return {body.vertices(), body.triangles()};
}

}  // namespace regrasp::sim
