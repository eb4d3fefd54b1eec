#include "planner/repair/canonical_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

std::vector<int> Numbers(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

PolygonSoup InCanonicalOrder(const PolygonSoup& soup) {
  std::vector<int> vertices = Numbers(soup.vertices.size());
  std::ranges::stable_sort(vertices, {}, [&](int v) {
    const Eigen::Vector3d& p = soup.vertices[v];
    return std::tuple(p.x(), p.y(), p.z());
  });
  PolygonSoup ordered;
  ordered.unit = soup.unit;
  std::vector<int> number(vertices.size());
  for (const int v : vertices) {
    number[v] = static_cast<int>(ordered.vertices.size());
    ordered.vertices.push_back(soup.vertices[v]);
  }
  std::vector<std::vector<int>> renumbered;
  for (std::vector<int> facet : soup.facets) {
    for (int& v : facet) v = number[v];
    std::ranges::rotate(facet, std::ranges::min_element(facet));
    renumbered.push_back(std::move(facet));
  }
  std::vector<int> facets = Numbers(soup.facets.size());
  std::ranges::stable_sort(
      facets, {}, [&](int f) -> const auto& { return renumbered[f]; });
  for (const int f : facets) {
    ordered.facets.push_back(renumbered[f]);
    if (!soup.filled.empty()) ordered.filled.push_back(soup.filled[f]);
  }
  return ordered;
}

}  // namespace regrasp::repair
