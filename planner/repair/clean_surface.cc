#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "planner/object/diameter.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace pmp = CGAL::Polygon_mesh_processing;

namespace {

using MeshPoint = Kernel::Point_3;
using Cell = std::array<std::int64_t, 3>;

/// For each vertex the first one within `distance` that stands for it.
std::vector<int> FindTwins(const std::vector<Eigen::Vector3d>& vertices, double distance) {
  std::map<Cell, std::vector<int>> standing;
  std::vector<int> twin(vertices.size());
  for (int v = 0; v < std::ssize(vertices); ++v) {
    const Eigen::Vector3d& p = vertices[v];
    const auto cell_of = [&](int axis) {
      return static_cast<std::int64_t>(std::floor(p[axis] / distance));
    };
    const Cell cell = {cell_of(0), cell_of(1), cell_of(2)};
    twin[v] = v;
    for (int i = 0; i < 27 && twin[v] == v; ++i) {
      const auto found =
          standing.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == standing.end()) continue;
      for (const int other : found->second) {
        if ((vertices[other] - p).norm() <= distance) twin[v] = other;
      }
    }
    if (twin[v] == v) standing[cell].push_back(v);
  }
  return twin;
}

/// A polygon's corners after welding, none twice in a row.
std::vector<int> CornersOf(const std::vector<int>& facet, const std::vector<int>& twin) {
  std::vector<int> corners;
  for (const int v : facet) {
    if (corners.empty() || corners.back() != twin[v]) corners.push_back(twin[v]);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

/// The triangles of least area that fill a polygon.
void AddTriangles(const std::vector<int>& corners, const std::vector<MeshPoint>& points,
                  std::vector<std::vector<std::size_t>>& triangles) {
  if (corners.size() < 3) return;
  std::vector<MeshPoint> outline;
  for (const int v : corners) outline.push_back(points[v]);
  std::vector<CGAL::Triple<int, int, int>> patch = {{0, 1, 2}};
  if (corners.size() > 3) {
    patch.clear();
    pmp::triangulate_hole_polyline(outline, std::back_inserter(patch));
  }
  for (const auto& [a, b, c] : patch) {
    triangles.push_back(
        {std::size_t(corners[a]), std::size_t(corners[b]), std::size_t(corners[c])});
  }
}

object::PolygonSoup ToSoup(const std::vector<MeshPoint>& points,
                           const std::vector<std::vector<std::size_t>>& triangles) {
  object::PolygonSoup soup;
  for (const MeshPoint& p : points) soup.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& t : triangles) soup.facets.push_back({int(t[0]), int(t[1]), int(t[2])});
  return soup;
}

/// Closes seams and drops what has no area, where CGAL can.
Mesh Tidied(Mesh mesh) {
  pmp::stitch_borders(mesh);
  pmp::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  return mesh;
}

}  // namespace

StageResult CleanSurface(const object::PolygonSoup& soup) {
  std::vector<MeshPoint> points;
  for (const auto& v : soup.vertices) points.emplace_back(v.x(), v.y(), v.z());
  const double diameter = object::ComputeDiameter(soup.vertices);
  const std::vector<int> twin = FindTwins(soup.vertices, kWeldDistance * diameter);
  std::vector<std::vector<std::size_t>> triangles;
  int polygons = 0;
  for (const auto& facet : soup.facets) {
    const std::vector<int> corners = CornersOf(facet, twin);
    polygons += corners.size() > 3;
    AddTriangles(corners, points, triangles);
  }
  const std::size_t cut = triangles.size();
  pmp::repair_polygon_soup(points, triangles);
  const std::size_t kept = triangles.size();
  const bool oriented = pmp::orient_polygon_soup(points, triangles);
  if (triangles.empty()) throw std::runtime_error("it has no facet with an area");
  StageResult result;
  result.facts["polygons_cut"] = polygons;
  result.facts["facets_dropped"] = cut - kept;
  result.facts["consistently_oriented"] = oriented;
  result.soup = SoupOf(Tidied(MeshOf(ToSoup(points, triangles))));
  return result;
}

}  // namespace regrasp::repair
