#include "planner/repair/filled_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "planner/object/facet_triangulation.h"
#include "planner/repair/surface_distance.h"

namespace regrasp::repair {

using Eigen::Vector3d;
using object::PolygonSoup;

namespace {

bool IsMarked(const PolygonSoup& soup, std::size_t facet) {
  return !soup.filled.empty() && soup.filled[facet];
}

bool HasMarks(const PolygonSoup& soup) {
  return std::ranges::find(soup.filled, true) != soup.filled.end();
}

/// Return the marked polygons, or the unmarked ones, as triangles.
PolygonSoup TrianglesOf(const PolygonSoup& soup, bool marked) {
  PolygonSoup triangles{soup.vertices, {}};
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const std::vector<int>& facet = soup.facets[f];
    if (IsMarked(soup, f) != marked || facet.size() < 3) continue;
    std::vector<Vector3d> corners;
    for (const int v : facet) corners.push_back(soup.vertices[v]);
    for (const auto& [a, b, c] : object::CutPolygon(corners).triangles) {
      triangles.facets.push_back({facet[a], facet[b], facet[c]});
    }
  }
  return triangles;
}

/// Return the tested points of a triangle: its centroid, and the midpoints between centroid and
/// corners.
std::array<Vector3d, 4> CornersOf(const PolygonSoup& solid, std::size_t facet) {
  const auto& f = solid.facets[facet];
  const Vector3d &a = solid.vertices[f[0]], &b = solid.vertices[f[1]], &c = solid.vertices[f[2]];
  const Vector3d centre = (a + b + c) / 3;
  return {centre, (centre + a) / 2, (centre + b) / 2, (centre + c) / 2};
}

double AreaOf(const PolygonSoup& triangles) {
  double area = 0;
  for (const auto& f : triangles.facets) {
    const Vector3d& a = triangles.vertices[f[0]];
    area += (triangles.vertices[f[1]] - a).cross(triangles.vertices[f[2]] - a).norm() / 2;
  }
  return area;
}

/// Mark triangles that are nearer to the original's filled surface than to its other surface.
void InheritMarks(const PolygonSoup& original, PolygonSoup& solid) {
  const PolygonSoup filled = TrianglesOf(original, true), known = TrianglesOf(original, false);
  if (filled.facets.empty()) return;
  if (known.facets.empty()) {
    solid.filled.assign(solid.facets.size(), true);
    return;
  }
  const SurfaceDistance to_filled(filled), to_known(known);
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    const std::array<Vector3d, 4> points = CornersOf(solid, f);
    if (std::ranges::any_of(points, [&](const Vector3d& p) {
          return to_filled.DistanceTo(p) < to_known.DistanceTo(p);
        })) {
      solid.filled[f] = true;
    }
  }
}

}  // namespace

void MarkFilled(const PolygonSoup& original, const Comparison& comparison, PolygonSoup& solid) {
  solid.filled = comparison.filled;
  solid.filled.resize(solid.facets.size(), false);
  if (HasMarks(original)) InheritMarks(original, solid);
}

double FilledShare(const PolygonSoup& solid) {
  const double filled = AreaOf(TrianglesOf(solid, true));
  return filled / (filled + AreaOf(TrianglesOf(solid, false)));
}

void FilledLast(PolygonSoup& solid) {
  if (!HasMarks(solid)) solid.filled.clear();
  PolygonSoup sorted{solid.vertices, {}};
  for (const bool filled : {false, true}) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      if (IsMarked(solid, f) != filled) continue;
      sorted.facets.push_back(solid.facets[f]);
      if (!solid.filled.empty()) sorted.filled.push_back(filled);
    }
  }
  solid = std::move(sorted);
}

}  // namespace regrasp::repair
