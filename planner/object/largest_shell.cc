#include "planner/object/largest_shell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/edge_sides.h"
#include "planner/object/surface_parts.h"

namespace regrasp::object {

namespace {

Eigen::AlignedBox3d BoxOf(const WeldedSoup& soup, const std::vector<int>& facets) {
  Eigen::AlignedBox3d box;
  for (const int f : facets) {
    for (const int v : soup.facets[f]) box.extend(soup.vertices[v]);
  }
  return box;
}

/// Which parts lie inside one and are oriented the other way.
std::vector<bool> FindCavities(const WeldedSoup& soup, const SurfaceParts& parts,
                               const std::vector<double>& volumes, std::size_t outside) {
  const Eigen::AlignedBox3d box = BoxOf(soup, parts.facets[outside]);
  std::vector<bool> is_cavity;
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    const Eigen::Vector3d& point = soup.vertices[soup.facets[parts.facets[p][0]][0]];
    constexpr double kHalf = 0.5;  // between 0, outside, and ±1
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

}  // namespace regrasp::object
