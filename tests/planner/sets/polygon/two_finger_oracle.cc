#include "tests/planner/sets/polygon/two_finger_oracle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "bench/polygon_set_cells.h"
#include "tests/planner/sets/exact_region.h"

namespace regrasp::polygon {
namespace {

using Number = CellKernel::FT;
using Vec = exact::Vec<Number>;
using Edge = exact::Edge<Number>;
using Region = exact::Region<Number>;

/// Distance beyond the corners of all bounded cells in the tests, divided by an edge's length.
constexpr double kFarthestReach = 0x1p200;

struct Range {
  Number low;
  Number high;
};

/// Return the contacts on an edge that a cell sees. The upper end of the range that x sees is
/// convex in x, the lower end concave. The corners of the cell therefore determine the range.
Range SeenRange(const SetCell& cell, const Edge& edge, double tangent) {
  const Number length = Dot(edge.along, edge.along);
  std::optional<Range> range;
  const auto& outline = cell.component.outer_boundary();
  for (auto x = outline.vertices_begin(); x != outline.vertices_end(); ++x) {
    const Vec r = Vec{x->x(), x->y()} - edge.a;
    const Number reach = Number(tangent) * CGAL::abs(Cross(edge.along, r)) / length;
    const Number u = Dot(r, edge.along) / length;
    if (!range) range = {u - reach, u + reach};
    range->low = std::min(range->low, Number(u - reach));
    range->high = std::max(range->high, Number(u + reach));
  }
  return {std::max(range->low, Number(0)), std::min(range->high, Number(1))};
}

}  // namespace

TwoFingerCount CompareTwoFingerSets(const object::Polygon& polygon, const PolygonGraph& graph,
                                    double friction_angle, std::string& difference) {
  std::ostringstream out;
  TwoFingerCount count;
  const double tangent = std::tan(friction_angle);
  const int n = polygon.face_count();
  std::vector<Edge> edges;
  for (int e = 0; e < n; ++e) edges.push_back(exact::MakeEdge<Number>(polygon, e, tangent));

  // Triples with several components are ignored, because graph_oracle tests which one is which.
  std::map<std::vector<FaceIndex>, double> tangents;
  for (const GraspSet& set : graph.sets()) {
    if (set.type == GraspType::kConcurrent) tangents[set.edges] = set.tangent;
  }
  std::vector<SetCandidate> candidates;
  for (const auto& [e, t] : tangents) candidates.push_back({{e[0], e[1], e[2]}, t});
  const std::vector<SetCell> cells = FindSetCells(polygon, candidates, kFarthestReach);

  std::vector<int> neighbours;
  int combinations = 0;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      const int sets_before = count.sets;
      if (ConesOppose(edges[a], edges[b])) ++count.candidates;
      for (const int part : {0, 1}) {
        const Region region = exact::TwoFingerRegion(edges[a], edges[b], part == 0 ? 1 : -1);
        std::vector<int> found;
        for (const sets::SetIndex v : graph.SetsOn({FaceIndex(a), FaceIndex(b)})) {
          if (graph.sets()[v].parts == std::vector<int>{part}) found.push_back(v);
        }
        const bool has_interior = exact::TwiceArea(region) != 0;
        if (found.size() != (has_interior ? 1 : 0)) {
          out << "edges " << a << ' ' << b << " part " << part << ": " << found.size()
              << " vertices\n";
        }
        if (found.size() != 1 || !has_interior) continue;
        ++count.sets;
        graph.GetNeighbours(found[0], neighbours);
        for (const SetCell& cell : cells) {
          const std::vector<FaceIndex> triple(cell.edges.begin(), cell.edges.end());
          const std::vector<sets::SetIndex> vertices = graph.SetsOn(triple);
          std::vector<int> concurrent;
          for (const int v : vertices) {
            if (graph.sets()[v].type == GraspType::kConcurrent) concurrent.push_back(v);
          }
          if (concurrent.size() != 1) continue;
          bool joined = false;
          for (const int k : {0, 1}) {
            const int e = k == 0 ? a : b;
            if (std::count(triple.begin(), triple.end(), e) == 0) continue;
            const Range seen = SeenRange(cell, edges[e], tangents[triple]);
            const auto [low, high] =
                std::minmax_element(region.begin(), region.end(),
                                    [k](const auto& u, const auto& v) { return u[k] < v[k]; });
            joined = joined || (seen.low < (*high)[k] && (*low)[k] < seen.high);
          }
          const bool in_graph = std::count(neighbours.begin(), neighbours.end(), concurrent[0]) > 0;
          if (joined) ++count.switches;
          if (joined != in_graph) {
            out << "edges " << a << ' ' << b << " part " << part << " and triple " << triple[0]
                << ' ' << triple[1] << ' ' << triple[2] << (joined ? " are" : " are not")
                << " joined\n";
          }
        }
      }
      if (count.sets > sets_before) ++combinations;
    }
  }
  const GraspTypeCounts& counts = graph.counts(GraspType::kTwoFinger);
  if (counts.candidates != count.candidates) {
    out << "candidates " << counts.candidates << ", by borders " << count.candidates << '\n';
  }
  if (counts.combinations != combinations) {
    out << "combinations " << counts.combinations << ", by clipping " << combinations << '\n';
  }
  if (counts.vertices != count.sets) {
    out << "vertices " << counts.vertices << ", by clipping " << count.sets << '\n';
  }
  difference = out.str();
  return count;
}

}  // namespace regrasp::polygon
