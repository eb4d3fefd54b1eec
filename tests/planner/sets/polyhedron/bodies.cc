#include "tests/planner/sets/polyhedron/bodies.h"

#include <algorithm>

#include "bench/polyhedron_stone.h"
#include "planner/object/polygon.h"
#include "tests/fixtures/moved.h"

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

const char* Name(planning::Spanning spanning) {
  return spanning == planning::Spanning::kUniform ? "uniform" : "adaptive";
}

object::Polyhedron RegularTetrahedron() {
  const object::PolygonSoup soup{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                                 {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  return object::Polyhedron::FromSoup(soup, "regular tetrahedron");
}

object::Polyhedron RegularOctahedron() {
  object::PolygonSoup soup;
  for (int axis = 0; axis < 3; ++axis) {
    soup.vertices.push_back(Vector3d::Unit(axis));
    soup.vertices.push_back(-Vector3d::Unit(axis));
  }
  for (int x = 0; x < 2; ++x) {
    for (int y = 2; y < 4; ++y) {
      for (int z = 4; z < 6; ++z) {
        std::vector<int> facet = {x, y, z};
        if ((x + y + z) % 2 != 0) std::swap(facet[1], facet[2]);
        soup.facets.push_back(facet);
      }
    }
  }
  return object::Polyhedron::FromSoup(soup, "regular octahedron");
}

object::Polyhedron Box(const Vector3d& size) {
  object::PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
    soup.vertices.push_back(corner.cwiseProduct(size));
  }
  soup.facets = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return object::Polyhedron::FromSoup(soup, "box");
}

object::Polyhedron Frustum(const std::vector<Ring>& rings, double height, double taper) {
  object::PolygonSoup soup;
  for (const Ring& ring : rings) {
    for (const Vector2d& p : ring) soup.vertices.emplace_back(p.x(), p.y(), 0);
  }
  const int above = static_cast<int>(soup.vertices.size());
  for (int i = 0; i < above; ++i) {
    const Vector3d& p = soup.vertices[i];
    soup.vertices.push_back(Vector3d(taper * p.x(), taper * p.y(), height));
  }
  const object::Polygon outline = object::Polygon::FromRings(rings, "outline");
  for (const auto& [a, b, c] : object::TriangulatePolygon(outline)) {
    soup.facets.push_back({c, b, a});
    soup.facets.push_back({above + a, above + b, above + c});
  }
  int first = 0;
  for (const Ring& ring : rings) {
    const int n = static_cast<int>(ring.size());
    for (int i = 0; i < n; ++i) {
      const int a = first + i;
      const int b = first + (i + 1) % n;
      soup.facets.push_back({a, b, above + b, above + a});
    }
    first += n;
  }
  return object::Polyhedron::FromSoup(soup, "frustum");
}

std::vector<Ring> LOutline() {
  return {{{-1.5, -1.5}, {2.5, -1.5}, {2.5, 0.5}, {0.5, 0.5}, {0.5, 2.5}, {-1.5, 2.5}}};
}

std::vector<Ring> FrameOutline() {
  return {{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}};
}

std::vector<Ring> BoomerangOutline() {
  return {{{-1.5, -1.3}, {2.6, -1.5}, {2.2, 0.1}, {0.2, 0.4}, {1, 2.3}, {-0.7, 2.6}}};
}

std::vector<Ring> RingOutline() {
  return {{{-2.1, -1.4}, {0.3, -2.3}, {2.4, -0.5}, {1.2, 2}, {-1.5, 1.6}},
          {{-0.9, -0.6}, {-0.4, 0.9}, {1, -0.3}}};
}

namespace {

/// Return a linear map without equal lengths or right angles.
Eigen::Affine3d Skewed() {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() << 1, 0.11, 0.07, -0.05, 0.93, 0.13, 0.03, -0.08, 1.06;
  return map;
}

object::Polyhedron SkewedBody(const object::Polyhedron& body) {
  return object::Polyhedron::FromSoup(MappedSoup(body, Skewed()), "skewed");
}

}  // namespace

const std::vector<NamedBody>& SmallBodies() {
  static const std::vector<NamedBody> bodies = {
      {"tetrahedron", SkewedBody(RegularTetrahedron())},
      {"round stone", MakeStone(10, Vector3d::Ones(), 1)},
      {"stretched stone", MakeStone(12, {2, 1, 0.7}, 2)},
      {"larger stone", MakeStone(18, {1.3, 1, 0.9}, 3)},
      {"frustum of a boomerang", SkewedBody(Frustum(BoomerangOutline(), 2, 0.4))},
      {"frustum of a ring", SkewedBody(Frustum(RingOutline(), 2, 0.4))},
  };
  return bodies;
}

}  // namespace regrasp::polyhedron
