#include "planner/object/surface_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

namespace {

Eigen::AlignedBox3d BoxOf(const WeldedSoup& soup, const std::vector<int>& facets) {
  Eigen::AlignedBox3d box;
  for (const int f : facets) {
    for (const int v : soup.facets[f]) box.extend(soup.vertices[v]);
  }
  return box;
}

/// Find the parts inside the outer shell that have the opposite orientation.
std::vector<bool> FindCavities(const WeldedSoup& soup, const SurfaceParts& parts,
                               const std::vector<double>& volumes, std::size_t outside) {
  const Eigen::AlignedBox3d box = BoxOf(soup, parts.facets[outside]);
  std::vector<bool> is_cavity;
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    const Eigen::Vector3d& point = soup.vertices[soup.facets[parts.facets[p][0]][0]];
    constexpr double kHalf = 0.5;  // between 0 (outside) and ±1
    is_cavity.push_back(volumes[p] * volumes[outside] < 0 &&
                        box.contains(BoxOf(soup, parts.facets[p])) &&
                        std::abs(WindingNumber(soup, parts.facets[outside], point)) > kHalf);
  }
  return is_cavity;
}

}  // namespace

std::optional<LargestShell> FindLargestShell(const WeldedSoup& soup) {
  const SurfaceParts parts = FindParts(soup, SortedEdgeSides(soup.facets, soup.vertices.size()));
  if (std::ranges::find(parts.closed, false) != parts.closed.end()) return std::nullopt;
  std::vector<double> volumes;
  for (const auto& facets : parts.facets) volumes.push_back(VolumeOf(soup, facets));
  const auto size = [](double volume) { return std::abs(volume); };
  const auto largest = std::ranges::max_element(volumes, {}, size);
  if (largest == volumes.end()) return std::nullopt;
  const auto outside = static_cast<std::size_t>(largest - volumes.begin());
  const std::vector<bool> is_cavity = FindCavities(soup, parts, volumes, outside);
  LargestShell found{soup, ""};
  int left_out = 0;
  double volume = 0, all = 0;
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    if (is_cavity[p]) continue;
    all += size(volumes[p]);
    if (p == outside) continue;
    ++left_out;
    volume += size(volumes[p]);
    for (const int f : parts.facets[p]) found.soup.facets[f].clear();
  }
  if (left_out == 0) return std::nullopt;
  DropUnused(found.soup);
  found.text = "the largest of " + std::to_string(left_out + 1) + " closed shells is the object; " +
               std::to_string(left_out) + " with " + FormatShort(100 * volume / all, 3) +
               " % of their volume " + (left_out == 1 ? "is" : "are") + " left out";
  return found;
}

using Eigen::Vector3d;

namespace {

/// Call `visit` with the corners of each triangle of a fan triangulation of the polygons.
template <class Visit>
void ForEachFanTriangle(const WeldedSoup& soup, const std::vector<int>& facets,
                        const Visit& visit) {
  for (const int f : facets) {
    const std::vector<int>& corners = soup.facets[f];
    for (std::size_t k = 2; k < corners.size(); ++k) {
      visit(soup.vertices[corners[0]], soup.vertices[corners[k - 1]], soup.vertices[corners[k]]);
    }
  }
}

}  // namespace

SurfaceParts FindParts(const WeldedSoup& soup, const std::vector<EdgeSide>& sides) {
  boost::disjoint_sets_with_storage<> joined(soup.facets.size());
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() == 2) joined.union_set(edge[0].facet, edge[1].facet);
  });
  SurfaceParts parts{std::vector<int>(soup.facets.size(), -1), {}, {}};
  std::vector<int> number(soup.facets.size(), -1);  // part of each set
  for (int f = 0; f < std::ssize(soup.facets); ++f) {
    if (soup.facets[f].empty()) continue;
    int& part = number[joined.find_set(f)];
    if (part < 0) {
      part = static_cast<int>(parts.facets.size());
      parts.facets.emplace_back();
    }
    parts.of_facet[f] = part;
    parts.facets[part].push_back(f);
  }
  // A part is closed if its polygons have each edge equally often in both directions.
  parts.closed.assign(parts.facets.size(), true);
  std::map<int, int> balance;
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    balance.clear();
    for (const EdgeSide& side : edge) balance[parts.of_facet[side.facet]] += side.forward ? 1 : -1;
    for (const auto& [part, sum] : balance) {
      if (sum != 0) parts.closed[part] = false;
    }
  });
  return parts;
}

double VolumeOf(const WeldedSoup& soup, const std::vector<int>& facets) {
  const Vector3d from = soup.vertices[soup.facets[facets[0]][0]];
  double volume = 0;
  ForEachFanTriangle(soup, facets, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    volume += (a - from).dot((b - from).cross(c - from)) / 6;
  });
  return volume;
}

double WindingNumber(const WeldedSoup& soup, const std::vector<int>& facets,
                     const Vector3d& point) {
  double half_angles = 0;
  ForEachFanTriangle(soup, facets, [&](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    const Vector3d a = p - point, b = q - point, c = r - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angles +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  });
  return half_angles / (2 * std::numbers::pi);
}

}  // namespace regrasp::object
