#include "planner/object/surface_parts.h"

#include <Eigen/Geometry>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

namespace regrasp::object {

using Eigen::Vector3d;

namespace {

/// Calls `visit` with the corners of the triangles of a fan of each facet.
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
  std::vector<int> number(soup.facets.size(), -1);  // of the part that a set is
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
  // A part is closed where its facets run along each edge as often one way as the other.
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
