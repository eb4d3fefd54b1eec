#include "tests/planner/sets/polygon/graph_oracle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "bench/polygon_set_cells.h"

namespace regrasp::polygon {
namespace {

using Region = CGAL::Polygon_2<CellKernel>;

/// Distance beyond all corners of bounded cells in the tests, divided by an edge's length. Two
/// lines with directions that are exact products of doubles intersect closer than this.
constexpr double kFarthestReach = 0x1p200;

/// Largest difference between min(tan θ, tan φ*) and a tangent, because tangents are rounded down.
constexpr double kTangentSlack = 1e-12;

/// Return the points within reach on the inner (left) or outer side of an edge's line.
CellSet HalfPlaneSet(const object::Polygon& polygon, int edge, bool outer) {
  const auto [a, b] = polygon.edge(FaceIndex(edge));
  const CellKernel::Point_2 pa(a.x(), a.y());
  const CellKernel::Vector_2 along = CellKernel::Point_2(b.x(), b.y()) - pa;
  const CellKernel::Vector_2 right = CellKernel::FT(8 * kFarthestReach) * along;
  const CellKernel::Vector_2 up = right.perpendicular(CGAL::COUNTERCLOCKWISE);
  Region box;
  box.push_back(pa - right);
  box.push_back(outer ? pa - right - up : pa + right);
  box.push_back(outer ? pa + right - up : pa + right + up);
  box.push_back(outer ? pa + right : pa - right + up);
  return CellSet(box);
}

/// Add the parts of a cell. Bit k of a part is set iff it is on the outer side of the k-th edge
/// (GraspSet::parts).
void AddParts(const object::Polygon& polygon, const SetCell& cell, const CellSet& rest, int k,
              int part, std::vector<int>& parts) {
  if (rest.is_empty()) return;
  if (k < 0) {
    parts.push_back(part);
    return;
  }
  for (const bool outer : {false, true}) {
    CellSet side = HalfPlaneSet(polygon, cell.edges[k], outer);
    side.intersection(rest);
    AddParts(polygon, cell, side, k - 1, outer ? part | 1 << k : part, parts);
  }
}

std::vector<int> PartsOf(const object::Polygon& polygon, const SetCell& cell) {
  std::vector<int> parts;
  AddParts(polygon, cell, CellSet(cell.component), 2, 0, parts);
  return parts;  // ascending, because the recursion begins with the third edge
}

/// Return whether the cell reaches the far end of the region that sees one of its edges.
bool ReachesEnd(const object::Polygon& polygon, const SetCell& cell) {
  const CellKernel::FT far(kFarthestReach / 2);
  const auto& outline = cell.component.outer_boundary();
  return std::any_of(cell.edges.begin(), cell.edges.end(), [&](int edge) {
    const auto [a, b] = polygon.edge(FaceIndex(edge));
    const CellKernel::Point_2 pa(a.x(), a.y());
    const CellKernel::Vector_2 along = CellKernel::Point_2(b.x(), b.y()) - pa;
    const CellKernel::Vector_2 normal = along.perpendicular(CGAL::COUNTERCLOCKWISE);
    return std::any_of(outline.vertices_begin(), outline.vertices_end(), [&](const auto& x) {
      return CGAL::abs(normal * (x - pa)) > far * along.squared_length();
    });
  });
}

struct Vertex {
  std::vector<FaceIndex> edges;
  std::vector<int> parts;
  auto operator<=>(const Vertex&) const = default;
};

template <class Number>
std::string Text(const std::vector<Number>& values) {
  std::ostringstream out;
  for (const int v : values) out << ' ' << v;
  return out.str();
}

std::string Text(const Vertex& v) { return "edges" + Text(v.edges) + " parts" + Text(v.parts); }

}  // namespace

OracleCount& OracleCount::operator+=(const OracleCount& other) {
  candidates += other.candidates;
  cells += other.cells;
  switches += other.switches;
  several += other.several;
  unbounded += other.unbounded;
  return *this;
}

OracleCount CompareWithSetOperations(const object::Polygon& polygon, const PolygonGraph& graph,
                                     double friction_angle, planning::Spanning spanning,
                                     std::string& difference) {
  std::ostringstream out;
  OracleCount count;
  std::vector<SetCandidate> candidates = spanning == planning::Spanning::kUniform
                                             ? FindUniformCandidates(polygon, friction_angle)
                                             : FindAdaptiveCandidates(polygon, friction_angle);
  std::map<std::vector<FaceIndex>, double> tangents;
  for (const SetCandidate& c : candidates) tangents[{c.edges.begin(), c.edges.end()}] = c.tangent;
  for (const GraspSet& set : graph.sets()) {
    if (set.type != GraspType::kConcurrent || !tangents.contains(set.edges)) continue;
    double& tangent = tangents[set.edges];
    if (set.tangent > tangent || set.tangent < tangent - kTangentSlack) {
      out << "tangent of" << Text(set.edges) << " off by " << set.tangent - tangent << '\n';
    }
    tangent = set.tangent;  // the graph is exact for its own tangents
  }
  for (SetCandidate& c : candidates) c.tangent = tangents[{c.edges.begin(), c.edges.end()}];
  count.candidates = static_cast<int>(candidates.size());
  const GraspTypeCounts& counts = graph.counts(GraspType::kConcurrent);
  if (counts.candidates != count.candidates) {
    out << "candidates " << counts.candidates << ", by set operations " << count.candidates << '\n';
  }

  const std::vector<SetCell> cells = FindSetCells(polygon, candidates, kFarthestReach);
  std::map<Vertex, int> cell_of;
  std::map<std::vector<FaceIndex>, int> components;
  for (const SetCell& cell : cells) {
    const std::vector<FaceIndex> edges(cell.edges.begin(), cell.edges.end());
    cell_of[{edges, PartsOf(polygon, cell)}] = static_cast<int>(&cell - cells.data());
    if (++components[edges] == 2) ++count.several;
    if (ReachesEnd(polygon, cell)) {
      ++count.unbounded;
      if (spanning == planning::Spanning::kUniform)
        out << "unbounded under uniform:" << Text(edges) << '\n';
    }
  }
  count.cells = static_cast<int>(cells.size());
  if (counts.combinations != static_cast<int>(components.size())) {
    out << "combinations " << counts.combinations << ", by set operations " << components.size()
        << '\n';
  }
  if (counts.vertices != count.cells) {
    out << "vertices " << counts.vertices << ", by set operations " << count.cells << '\n';
  }

  std::map<int, int> vertex_of;
  for (int v = 0; v < graph.vertex_count(); ++v) {
    const GraspSet& set = graph.sets()[v];
    if (set.type != GraspType::kConcurrent) continue;
    const Vertex key{set.edges, set.parts};
    const auto found = cell_of.find(key);
    if (found == cell_of.end()) {
      out << "only the graph has " << Text(key) << '\n';
    } else {
      vertex_of[found->second] = v;
    }
  }
  for (const auto& [key, cell] : cell_of) {
    if (!vertex_of.contains(cell)) out << "the graph lacks " << Text(key) << '\n';
  }

  std::set<std::array<int, 2>> switches;
  for (const auto& [a, b] : FindSetCellSwitches(cells)) {
    if (!vertex_of.contains(a) || !vertex_of.contains(b)) continue;
    const auto [low, high] = std::minmax(vertex_of[a], vertex_of[b]);
    switches.insert({low, high});
  }
  count.switches = static_cast<int>(switches.size());
  std::set<std::array<int, 2>> graph_switches;
  std::vector<int> neighbours;
  for (int v = 0; v < graph.vertex_count(); ++v) {
    if (graph.sets()[v].type != GraspType::kConcurrent) continue;
    graph.GetNeighbours(v, neighbours);
    for (const int w : neighbours) {
      if (w > v && graph.sets()[w].type == GraspType::kConcurrent) graph_switches.insert({v, w});
    }
  }
  std::vector<std::array<int, 2>> different;
  std::set_symmetric_difference(switches.begin(), switches.end(), graph_switches.begin(),
                                graph_switches.end(), std::back_inserter(different));
  for (const auto& pair : different) {
    const GraspSet& a = graph.sets()[pair[0]];
    const GraspSet& b = graph.sets()[pair[1]];
    out << (switches.contains(pair) ? "the graph lacks" : "only the graph has") << " the switch of "
        << Text(Vertex{a.edges, a.parts}) << " and " << Text(Vertex{b.edges, b.parts}) << '\n';
  }
  if (graph.edge_count(GraspType::kConcurrent, GraspType::kConcurrent) !=
      static_cast<int>(graph_switches.size())) {
    out << "edge_count is not the number of neighbours\n";
  }
  difference = out.str();
  return count;
}

}  // namespace regrasp::polygon
