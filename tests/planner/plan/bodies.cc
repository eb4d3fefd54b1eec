#include "bodies.h"

#include <algorithm>

namespace regrasp {

namespace {

PolygonSoup Extrude(const std::vector<Eigen::Vector2d>& outline) {
  PolygonSoup soup;
  const int count = static_cast<int>(outline.size());
  for (const double z : {0.0, 1.0}) {
    for (const Eigen::Vector2d& p : outline) soup.vertices.emplace_back(p.x(), p.y(), z);
  }
  std::vector<int> bottom, top;
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    bottom.push_back(count - 1 - i);
    top.push_back(count + i);
    soup.facets.push_back({i, next, count + next, count + i});
  }
  soup.facets.push_back(bottom);
  soup.facets.push_back(top);
  return soup;
}

}  // namespace

Polyhedron MakeCube(double size, const Eigen::Vector3d& offset) {
  PolygonSoup soup = Extrude({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  for (Eigen::Vector3d& p : soup.vertices) {
    p.z() = 2 * p.z() - 1;
    p = size * p + offset;
  }
  return Polyhedron::FromSoup(soup, "cube");
}

Polyhedron MakePrism(const std::vector<Eigen::Vector2d>& outline) {
  return Polyhedron::FromSoup(Extrude(outline), "prism");
}

Polyhedron MakeLBlock() { return MakePrism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}); }

Polyhedron MakeRing() {
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const double half : {3.0, 1.0}) {
      soup.vertices.insert(
          soup.vertices.end(),
          {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
    }
  }
  // Vertices 0–3 are the outline below, 4–7 the hole below, 8–15 the same above.
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    soup.facets.push_back({i, next, 8 + next, 8 + i});
    soup.facets.push_back({4 + next, 4 + i, 12 + i, 12 + next});
    soup.facets.push_back({8 + i, 8 + next, 12 + next, 12 + i});
    soup.facets.push_back({next, i, 4 + i, 4 + next});
  }
  return Polyhedron::FromSoup(soup, "ring");
}

Polyhedron MakeHollowCube() {
  PolygonSoup soup = Extrude({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  for (Eigen::Vector3d& p : soup.vertices) p.z() = 2 * p.z() - 1;
  const PolygonSoup outside = soup;
  for (const Eigen::Vector3d& p : outside.vertices) soup.vertices.push_back(p / 2);
  for (std::vector<int> facet : outside.facets) {
    std::reverse(facet.begin(), facet.end());
    for (int& corner : facet) corner += static_cast<int>(outside.vertices.size());
    soup.facets.push_back(facet);
  }
  return Polyhedron::FromSoup(soup, "hollow cube");
}

Polygon MakeSquare(bool divided) {
  std::vector<Eigen::Vector2d> ring = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  if (divided) ring.insert(ring.begin() + 1, Eigen::Vector2d(0, -1));
  return Polygon::FromRings({ring}, "square");
}

}  // namespace regrasp
