#include "planner/object/polygon_triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <iterator>
#include <map>

namespace regrasp::object {

std::vector<std::array<int, 3>> TriangulatePolygon(const Polygon& polygon) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Polygon2 = CGAL::Polygon_2<Kernel>;
  std::vector<Polygon2> rings;
  std::map<Kernel::Point_2, int> index;
  for (const auto& ring : polygon.rings()) {
    Polygon2& out = rings.emplace_back();
    for (const Eigen::Vector2d& p : ring) {
      out.push_back({p.x(), p.y()});
      index.emplace(out.container().back(), static_cast<int>(index.size()));
    }
  }
  const CGAL::Polygon_with_holes_2<Kernel> region(rings.front(), rings.begin() + 1, rings.end());
  std::vector<Polygon2> pieces;
  CGAL::Polygon_triangulation_decomposition_2<Kernel>()(region, std::back_inserter(pieces));
  std::vector<std::array<int, 3>> triangles;
  for (Polygon2& piece : pieces) {
    if (piece.is_clockwise_oriented()) piece.reverse_orientation();
    triangles.push_back({index.at(piece[0]), index.at(piece[1]), index.at(piece[2])});
  }
  return triangles;
}

}  // namespace regrasp::object
