#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/object/polygon_soup.h"

namespace regrasp::testing {

/// Faces outward, as quadrilaterals; `from` and `to` are opposite corners.
inline PolygonSoup BoxSoup(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  PolygonSoup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.push_back(
        {i & 1 ? to.x() : from.x(), i & 2 ? to.y() : from.y(), i & 4 ? to.z() : from.z()});
  }
  soup.facets = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return soup;
}

inline PolygonSoup UnitCubeSoup() {
  return BoxSoup(Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5));
}

/// The corner tetrahedron of the unit cube: volume 1/6.
inline PolygonSoup CornerTetrahedronSoup() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A block 3 × 3 × 1 with a square hole 1 × 1 through its middle, along z; the faces with the hole
/// are four quadrilaterals each. Outer box from the origin.
inline PolygonSoup HoleBlockSoup() {
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0},
                               {3.0, 0.0},
                               {3.0, 3.0},
                               {0.0, 3.0},
                               {1.0, 1.0},
                               {2.0, 1.0},
                               {2.0, 2.0},
                               {1.0, 2.0}}) {
      soup.vertices.push_back({x, y, z});
    }
  }
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    soup.facets.push_back({i, i + 4, j + 4, j});            // below
    soup.facets.push_back({i + 8, j + 8, j + 12, i + 12});  // above
    soup.facets.push_back({i, j, j + 8, i + 8});            // outside
    soup.facets.push_back({i + 4, i + 12, j + 12, j + 4});  // in the hole
  }
  return soup;
}

/// An L of thickness 1, its two ends as one non-convex hexagon each: volume 3.
inline PolygonSoup LBlockSoup() {
  PolygonSoup soup;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}) {
      soup.vertices.push_back({x, y, z});
    }
  }
  soup.facets = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    soup.facets.push_back({i, j, j + 6, i + 6});
  }
  return soup;
}

/// A sphere of radius 1 with `rings` rows of `2 · rings` facets.
inline PolygonSoup SphereSoup(int rings) {
  PolygonSoup soup;
  const int around = 2 * rings;
  soup.vertices.push_back({0, 0, -1});
  for (int r = 1; r < rings; ++r) {
    const double latitude = std::numbers::pi * (double(r) / rings - 0.5);
    for (int a = 0; a < around; ++a) {
      const double longitude = 2 * std::numbers::pi * a / around;
      soup.vertices.push_back({std::cos(latitude) * std::cos(longitude),
                               std::cos(latitude) * std::sin(longitude), std::sin(latitude)});
    }
  }
  soup.vertices.push_back({0, 0, 1});
  const int top = static_cast<int>(soup.vertices.size()) - 1;
  const auto at = [&](int r, int a) { return 1 + (r - 1) * around + a % around; };
  for (int a = 0; a < around; ++a) {
    soup.facets.push_back({0, at(1, a + 1), at(1, a)});
    soup.facets.push_back({top, at(rings - 1, a), at(rings - 1, a + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      soup.facets.push_back({at(r, a), at(r, a + 1), at(r + 1, a + 1)});
      soup.facets.push_back({at(r, a), at(r + 1, a + 1), at(r + 1, a)});
    }
  }
  return soup;
}

inline void Transform(PolygonSoup& soup, const Eigen::Affine3d& transform) {
  for (auto& vertex : soup.vertices) vertex = transform * vertex;
}

inline void Turn(PolygonSoup& soup) {
  for (auto& facet : soup.facets) std::reverse(facet.begin(), facet.end());
}

/// Both soups in one.
inline PolygonSoup Join(PolygonSoup soup, const PolygonSoup& other) {
  const int offset = static_cast<int>(soup.vertices.size());
  soup.vertices.insert(soup.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto facet : other.facets) {
    for (int& v : facet) v += offset;
    soup.facets.push_back(facet);
  }
  return soup;
}

/// A rotation about no special axis and a shift.
inline Eigen::Affine3d SomeMotion() {
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(Eigen::Vector3d(0.7, -2.3, 1.9));
  motion.rotate(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -2).normalized()));
  return motion;
}

}  // namespace regrasp::testing
