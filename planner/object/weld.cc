#include "planner/object/weld.h"

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>
#include <cmath>
#include <unordered_map>

#include "planner/base/number.h"
#include "planner/object/mesh_defect.h"

namespace regrasp::object {

std::string SizeComplaint(const std::vector<Eigen::Vector3d>& vertices, double diameter) {
  if (!(diameter >= kMinDiameter)) {
    return "all vertices lie within " + FormatDouble(kMinDiameter) + " of each other";
  }
  const auto too_far = [&](const Eigen::Vector3d& v) { return v.norm() > kMaxOffset * diameter; };
  const auto found = std::ranges::find_if(vertices, too_far);
  if (found == vertices.end()) return "";
  return "too far from the origin (" + FormatShort(found->norm()) + ") for an object of diameter " +
         FormatShort(diameter);
}

std::string EdgeComplaint(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double diameter) {
  const double length = (to - from).stableNorm();
  if (length >= kMinEdge * diameter) return "";
  return "shorter (" + FormatShort(length) + ") than " + FormatDouble(kMinEdge) +
         " of the diameter (" + FormatShort(diameter) + "); make its ends one point";
}

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
                                                " must be finite and of size at most " +
                                                FormatDouble(kMaxCoordinate));
  }
}

}  // namespace

void DropRepeated(std::vector<int>& corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) corners.clear();
}

void DropUnused(WeldedSoup& soup) {
  std::vector<int> number(soup.vertices.size(), -1);
  for (const auto& facet : soup.facets) {
    for (const int v : facet) number[v] = 0;
  }
  int next = 0;
  for (int v = 0; v < std::ssize(soup.vertices); ++v) {
    if (number[v] < 0) continue;
    soup.vertices[next] = soup.vertices[v];
    soup.vertex_in_file[next] = soup.vertex_in_file[v];
    number[v] = next++;
  }
  if (next == std::ssize(soup.vertices)) return;
  soup.vertices.resize(next);
  soup.vertex_in_file.resize(next);
  for (auto& facet : soup.facets) {
    for (int& v : facet) v = number[v];
  }
}

WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name) {
  if (soup.facets.empty()) {
    throw MeshError(
        MeshDefect::kEmpty,
        name + ": empty: no facet" +
            (soup.vertices.empty() ? ""
                                   : ", but a cloud of " + std::to_string(soup.vertices.size()) +
                                         " points, of which a repair may make a body"));
  }
  if (soup.facets.size() > kMaxFacets) {
    throw MeshError(MeshDefect::kTooLarge, name + ": " + std::to_string(soup.facets.size()) +
                                               " facets, more than " + std::to_string(kMaxFacets));
  }
  WeldedSoup welded;
  welded.facets.reserve(soup.facets.size());
  using Coordinates = std::array<double, 3>;
  std::unordered_map<Coordinates, int, boost::hash<Coordinates>> at_coordinates;
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
    DropRepeated(corners);
    welded.facets.push_back(std::move(corners));
  }
  DropUnused(welded);
  return welded;
}

}  // namespace regrasp::object
