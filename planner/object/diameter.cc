#include "planner/object/diameter.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace regrasp {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

/// Below this the plain double loop is faster than building a tree.
constexpr std::size_t kFewPoints = 256;

double LargestSquaredByPairs(std::span<const Eigen::Vector3d> points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, (points[i] - points[j]).squaredNorm());
    }
  }
  return largest;
}

double LargestSquaredByTree(std::span<const Eigen::Vector3d> points) {
  std::vector<Kernel::Point_3> copies;
  copies.reserve(points.size());
  for (const auto& p : points) copies.emplace_back(p.x(), p.y(), p.z());
  Search::Tree tree(copies.begin(), copies.end());
  constexpr bool kNearest = false;  // farthest
  double largest = 0;
  for (const auto& p : copies) {
    const Search farthest(tree, p, 1, 0.0, kNearest);
    // Measured again rather than taken from the search, which adds up its distance in pieces.
    const Kernel::Vector_3 difference = farthest.begin()->first - p;
    largest = std::max(largest, difference.squared_length());
  }
  return largest;
}

}  // namespace

double ComputeDiameter(std::span<const Eigen::Vector3d> points) {
  return std::sqrt(points.size() <= kFewPoints ? LargestSquaredByPairs(points)
                                               : LargestSquaredByTree(points));
}

}  // namespace regrasp
