#include "planner/object/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/base/number.h"
#include "planner/object/mesh_defect.h"
#include "planner/object/size_limits.h"

namespace regrasp::object {

namespace {

std::string FacetName(const std::string& name, std::size_t facet) {
  return name + ": facet " + std::to_string(facet);
}

void CheckIndex(const PolygonSoup& soup, std::size_t facet, int index, const std::string& name) {
  if (index >= 0 && index < std::ssize(soup.vertices)) return;
  throw MeshError(MeshDefect::kIndexOutOfRange,
                  FacetName(name, facet) + ": vertex index " + std::to_string(index) +
                      " is out of range (" + std::to_string(soup.vertices.size()) + " vertices)");
}

void CheckCoordinates(const Eigen::Vector3d& vertex, int index, const std::string& name) {
  for (const double x : vertex) {
    if (std::abs(x) <= kMaxCoordinate) continue;  // false for NaN
    throw MeshError(MeshDefect::kNotFinite, name + ": vertex " + std::to_string(index) +
                                                ": the coordinate " + FormatDouble(x) +
                                                " is not finite or beyond " +
                                                FormatDouble(kMaxCoordinate));
  }
}

void CheckCorners(std::vector<int> corners, std::size_t facet, const WeldedSoup& welded,
                  const std::string& name) {
  if (corners.size() < 3) {
    throw MeshError(MeshDefect::kDegenerateFacet, FacetName(name, facet) +
                                                      ": degenerate: fewer than three corners (" +
                                                      std::to_string(corners.size()) + ")");
  }
  std::ranges::sort(corners);
  const auto twice = std::ranges::adjacent_find(corners);
  if (twice == corners.end()) return;
  throw MeshError(MeshDefect::kDegenerateFacet, FacetName(name, facet) +
                                                    ": degenerate: two of its corners are vertex " +
                                                    std::to_string(welded.vertex_in_file[*twice]));
}

}  // namespace

WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name) {
  if (soup.facets.empty()) throw MeshError(MeshDefect::kEmpty, name + ": empty: no facet");
  if (soup.facets.size() > kMaxFacets) {
    throw MeshError(MeshDefect::kTooLarge, name + ": " + std::to_string(soup.facets.size()) +
                                               " facets, more than " + std::to_string(kMaxFacets));
  }
  WeldedSoup welded;
  welded.facets.reserve(soup.facets.size());
  std::map<std::array<double, 3>, int> at_coordinates;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    std::vector<int> corners;
    for (const int index : soup.facets[f]) {
      CheckIndex(soup, f, index, name);
      CheckCoordinates(soup.vertices[index], index, name);
      // Adding 0 turns −0 into +0, so that printed coordinates and normals have no "-0".
      const Eigen::Vector3d vertex = soup.vertices[index].array() + 0.0;
      const auto [found, is_new] = at_coordinates.try_emplace(
          {vertex.x(), vertex.y(), vertex.z()}, static_cast<int>(welded.vertices.size()));
      if (is_new) {
        welded.vertices.push_back(vertex);
        welded.vertex_in_file.push_back(index);
      }
      corners.push_back(found->second);
    }
    CheckCorners(corners, f, welded, name);
    welded.facets.push_back(std::move(corners));
  }
  return welded;
}

}  // namespace regrasp::object
