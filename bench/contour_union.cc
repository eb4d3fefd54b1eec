#include "bench/contour_union.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "planner/search/switching_graph.h"
#include "planner/sets/contour/contact_space.h"

namespace regrasp {
namespace {

using Eigen::Vector2d;

/// Distance below which corners are merged, over the perimeter: polygons must not touch themselves.
constexpr double kSameCorner = 1e-13;

UnionPolygon MakeOutline(const std::vector<Vector2d>& corners, double same) {
  std::vector<Vector2d> kept;
  for (const Vector2d& p : corners) {
    if (kept.empty() || (p - kept.back()).lpNorm<Eigen::Infinity>() > same) kept.push_back(p);
  }
  while (kept.size() > 1 && (kept.front() - kept.back()).lpNorm<Eigen::Infinity>() <= same) {
    kept.pop_back();
  }
  UnionPolygon outline;
  for (const Vector2d& p : kept) outline.push_back({p.x(), p.y()});
  return outline;
}

/// Return the component that contains an outline.
int ComponentOf(const UnionPolygon& outline, const std::vector<UnionComponent>& components) {
  const auto middle = CGAL::centroid(outline.vertex(0), outline.vertex(1), outline.vertex(2));
  for (std::size_t c = 0; c < components.size(); ++c) {
    const UnionPolygon& border = components[c].outer_boundary();
    if (!CGAL::do_overlap(border.bbox(), outline.bbox())) continue;
    if (border.bounded_side(middle) != CGAL::ON_BOUNDED_SIDE) continue;
    const bool in_hole = std::any_of(
        components[c].holes_begin(), components[c].holes_end(),
        [&](const auto& hole) { return hole.bounded_side(middle) == CGAL::ON_BOUNDED_SIDE; });
    if (!in_hole) return static_cast<int>(c);
  }
  return -1;
}

}  // namespace

PieceOutlines MakePieceOutlines(const contour::ContourGraph& graph) {
  const contour::Boundary& boundary = graph.boundary();
  PieceOutlines result;
  for (contour::PieceIndex p{0}; p < std::ssize(graph.pieces()); ++p) {
    const auto& edges = graph.pieces()[p].edges;
    if (boundary.ring_of(edges[0]) != 0 || boundary.ring_of(edges[1]) != 0) continue;
    UnionPolygon outline = MakeOutline(contour::PieceOutline(graph, p),
                                       kSameCorner * boundary.perimeter(contour::RingIndex(0)));
    if (outline.size() < 3 || outline.orientation() != CGAL::COUNTERCLOCKWISE) continue;
    result.pieces.push_back(p);
    result.outlines.push_back(std::move(outline));
  }
  return result;
}

std::vector<UnionComponent> Unite(const std::vector<UnionPolygon>& outlines) {
  CGAL::Polygon_set_2<UnionKernel> united;
  united.join(outlines.begin(), outlines.end());
  std::vector<UnionComponent> components;
  united.polygons_with_holes(std::back_inserter(components));
  return components;
}

int CountGlued(const contour::ContourGraph& graph, const PieceOutlines& outlines,
               const std::vector<UnionComponent>& components) {
  std::map<contour::PieceIndex, int> index_of;
  for (std::size_t i = 0; i < outlines.pieces.size(); ++i) {
    index_of[outlines.pieces[i]] = static_cast<int>(i);
  }
  const contour::Boundary& boundary = graph.boundary();
  std::vector<std::array<int, 2>> glued;
  for (const contour::PiecePassage& passage : graph.passages()) {
    if (boundary.next(passage.edge) > passage.edge) continue;  // not the start of a ring
    const auto before = index_of.find(passage.pieces[0]);
    const auto after = index_of.find(passage.pieces[1]);
    if (before == index_of.end() || after == index_of.end()) continue;
    const int a = ComponentOf(outlines.outlines[before->second], components);
    const int b = ComponentOf(outlines.outlines[after->second], components);
    if (a >= 0 && b >= 0) glued.push_back({a, b});
  }
  return search::ComponentsOfEdges(static_cast<int>(components.size()), glued).count();
}

}  // namespace regrasp
