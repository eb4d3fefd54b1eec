#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace {

using Point = Kernel::Point_3;

/// A triangle with an edge longer than this, in typical distances between neighbours, bridges what
/// was not scanned.
constexpr double kLongEdge = 8;

/// Fewest points that can be a body.
constexpr std::size_t kFewestPoints = 10;

/// The middle one of the distances from points to their nearest others.
double TypicalDistance(const std::vector<Point>& points) {
  using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;
  const Search::Tree tree(points.begin(), points.end());
  std::vector<double> distances;
  for (const Point& p : points) {
    Search search(tree, p, 2);  // itself first
    distances.push_back(std::sqrt(std::next(search.begin())->second));
  }
  const auto middle = distances.begin() + std::ssize(distances) / 2;
  std::ranges::nth_element(distances, middle);
  return *middle;
}

}  // namespace

StageResult ReconstructSurface(const object::PolygonSoup& cloud) {
  std::vector<Point> points;
  for (const auto& v : cloud.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < kFewestPoints) throw std::runtime_error("fewer than ten points");
  const double longest = kLongEdge * TypicalDistance(points);
  std::vector<std::array<std::size_t, 3>> triangles;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(),
                                               std::back_inserter(triangles));
  StageResult result;
  for (const Point& p : points) result.soup.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : triangles) {
    const double edge = std::sqrt(std::max({CGAL::squared_distance(points[a], points[b]),
                                            CGAL::squared_distance(points[b], points[c]),
                                            CGAL::squared_distance(points[c], points[a])}));
    if (edge <= longest) result.soup.facets.push_back({int(a), int(b), int(c)});
  }
  if (result.soup.facets.empty()) throw std::runtime_error("its points form no surface");
  result.facts["points"] = points.size();
  result.facts["typical_distance"] = longest / kLongEdge;
  result.facts["triangles_that_bridge"] = triangles.size() - result.soup.facets.size();
  return result;
}

}  // namespace regrasp::repair
