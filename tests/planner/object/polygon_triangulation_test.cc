#include <gtest/gtest.h>

#include "planner/object/polygon.h"

namespace regrasp::object {
namespace polygon_triangulation_test {

TEST(TriangulatePolygon, TrianglesCoverThePolygonAndNotItsHole) {
  const Polygon polygon = Polygon::FromRings(
      {{{0, 0}, {6, 0}, {6, 2}, {3, 2}, {3, 5}, {0, 5}}, {{1, 1}, {1, 1.5}, {2, 1}}}, "l");
  std::vector<Eigen::Vector2d> vertices;
  for (const auto& ring : polygon.rings())
    vertices.insert(vertices.end(), ring.begin(), ring.end());
  double area = 0;
  const auto triangles = TriangulatePolygon(polygon);
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector2d u = vertices[b] - vertices[a];
    const Eigen::Vector2d v = vertices[c] - vertices[a];
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  // A polygon of n vertices with h holes has n + 2 h − 2 triangles.
  EXPECT_EQ(triangles.size(), 9u + 2 - 2);
  EXPECT_NEAR(area, polygon.mass_properties().volume, 1e-12);
}

}  // namespace polygon_triangulation_test
}  // namespace regrasp::object
