#include "tests/planner/sets/polygon/two_finger_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "bench/polygon_set_cells.h"

namespace regrasp {
namespace {

using Number = CellKernel::FT;
using Point = CellKernel::Point_2;
using Vector = CellKernel::Vector_2;

/// Farther than the corners of any bounded cell of the tests, over an edge's length.
constexpr double kFarthestReach = 0x1p200;

struct Edge {
  Point a;
  Vector along;
  Vector right;  ///< borders of the cone about the inward normal
  Vector left;
};

Number Cross(const Vector& a, const Vector& b) { return a.x() * b.y() - a.y() * b.x(); }

Edge MakeEdge(const Polygon& polygon, int edge, double tangent) {
  const auto [a, b] = polygon.edge(edge);
  const Point pa(a.x(), a.y());
  const Vector along = Point(b.x(), b.y()) - pa;
  const Vector n = along.perpendicular(CGAL::COUNTERCLOCKWISE);
  const Number t(tangent);
  return {pa, along, n + t * along, n - t * along};
}

/// C(n_a) and −C(n_b) have a common interior: the borders of −C(n_b) are on either side of a
/// border, or the reverse; both cones are less than π wide.
bool ConesOppose(const Edge& a, const Edge& b) {
  const auto inside = [](const Edge& e, const Vector& v) {
    return Cross(e.right, v) > 0 && Cross(v, e.left) > 0;
  };
  // Of two open cones that meet, one has a border or the middle of the other inside.
  const std::array of_b = {-b.right, -b.left, -(b.right + b.left)};
  const std::array of_a = {-a.right, -a.left, -(a.right + a.left)};
  return std::any_of(of_b.begin(), of_b.end(), [&](const Vector& v) { return inside(a, v); }) ||
         std::any_of(of_a.begin(), of_a.end(), [&](const Vector& v) { return inside(b, v); });
}

/// A convex polygon of parameters (u_a, u_b).
using Region = std::vector<std::array<Number, 2>>;

/// The part where sign · cross(w, p_b(u_b) − p_a(u_a)) >= 0.
Region Clip(const Region& region, const Edge& a, const Edge& b, const Vector& w, int sign) {
  const auto value = [&](const std::array<Number, 2>& u) {
    return Number(sign) * Cross(w, (b.a - a.a) + u[1] * b.along - u[0] * a.along);
  };
  Region clipped;
  for (std::size_t k = 0; k < region.size(); ++k) {
    const auto& from = region[k];
    const auto& to = region[(k + 1) % region.size()];
    const Number f = value(from);
    const Number g = value(to);
    if (f >= 0) clipped.push_back(from);
    if ((f > 0 && g < 0) || (f < 0 && g > 0)) {
      const Number s = f / (f - g);
      clipped.push_back({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
    }
  }
  return clipped;
}

bool HasInterior(const Region& region) {
  Number area = 0;
  for (std::size_t k = 1; k + 1 < region.size(); ++k) {
    area += (region[k][0] - region[0][0]) * (region[k + 1][1] - region[0][1]) -
            (region[k][1] - region[0][1]) * (region[k + 1][0] - region[0][0]);
  }
  return area != 0;
}

/// The grasps that squeeze (sign 1) or stretch (−1), border included.
Region TwoFingerRegion(const Edge& a, const Edge& b, int sign) {
  Region region = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  region = Clip(region, a, b, a.right, sign);
  region = Clip(region, a, b, a.left, -sign);
  region = Clip(region, a, b, b.right, -sign);
  return Clip(region, a, b, b.left, sign);
}

struct Range {
  Number low;
  Number high;
};

/// The contacts on an edge that a cell sees. How far x sees up the edge is convex in x, and how far
/// down concave, so corners are enough.
Range SeenRange(const SetCell& cell, const Edge& edge, double tangent) {
  const Number length = edge.along.squared_length();
  std::optional<Range> range;
  const auto& outline = cell.component.outer_boundary();
  for (auto x = outline.vertices_begin(); x != outline.vertices_end(); ++x) {
    const Vector r = *x - edge.a;
    const Number reach = Number(tangent) * CGAL::abs(Cross(edge.along, r)) / length;
    const Number u = (r * edge.along) / length;
    if (!range) range = {u - reach, u + reach};
    range->low = std::min(range->low, Number(u - reach));
    range->high = std::max(range->high, Number(u + reach));
  }
  return {std::max(range->low, Number(0)), std::min(range->high, Number(1))};
}

}  // namespace

TwoFingerCount CompareTwoFingerSets(const Polygon& polygon, const PolygonGraph& graph,
                                    double half_angle, std::string& difference) {
  std::ostringstream out;
  TwoFingerCount count;
  const double tangent = std::tan(half_angle);
  const int n = polygon.face_count();
  std::vector<Edge> edges;
  for (int e = 0; e < n; ++e) edges.push_back(MakeEdge(polygon, e, tangent));

  // Cells of triples that fall apart are left out: which one is which is decided elsewhere.
  std::map<std::vector<int>, double> tangents;
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
        const Region region = TwoFingerRegion(edges[a], edges[b], part == 0 ? 1 : -1);
        std::vector<int> found;
        for (const int v : graph.SetsOn({a, b})) {
          if (graph.sets()[v].parts == std::vector<int>{part}) found.push_back(v);
        }
        if (found.size() != (HasInterior(region) ? 1 : 0)) {
          out << "edges " << a << ' ' << b << " part " << part << ": " << found.size()
              << " vertices\n";
        }
        if (found.size() != 1 || !HasInterior(region)) continue;
        ++count.sets;
        graph.GetNeighbours(found[0], neighbours);
        for (const SetCell& cell : cells) {
          const std::vector<int> triple(cell.edges.begin(), cell.edges.end());
          const std::vector<int> vertices = graph.SetsOn(triple);
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

}  // namespace regrasp
