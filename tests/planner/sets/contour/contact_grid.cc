#include "tests/planner/sets/contour/contact_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "planner/grasp/force_closure.h"
#include "planner/search/switching_graph.h"
#include "planner/sets/contour/contact_space.h"

namespace regrasp::contour {
namespace {

using Eigen::Vector2d;

/// Minimum number of lines per edge.
constexpr int kLeastLines = 4;

/// Largest distance of a grasp from its outline due to rounding, divided by the diameter.
constexpr double kOutlineRounding = 1e-9;

grasp::Contact ContactOn(const object::Polygon& polygon, int edge, double share) {
  const auto [from, to] = polygon.edge(FaceIndex(edge));
  return {(1 - share) * from + share * to, polygon.inward_normal(FaceIndex(edge)), FaceIndex(edge)};
}

/// Return the depth of a point inside a convex outline; negative outside. Sides within rounding
/// have no direction and are ignored.
double DepthIn(const std::vector<Vector2d>& outline, const Vector2d& p, double rounding) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
    const Vector2d r = p - outline[i];
    if (side.norm() > rounding) {
      depth = std::min(depth, (side.x() * r.y() - side.y() * r.x()) / side.norm());
    }
  }
  return outline.empty() ? -depth : depth;
}

bool IsGrasp(Sense sense) { return sense == Sense::kSqueezing || sense == Sense::kStretching; }

}  // namespace

Sense SenseOf(const object::Polygon& polygon, double friction_angle, const grasp::Contact& a,
              const grasp::Contact& b) {
  const std::array<grasp::Contact, 2> grasp = {a, b};
  switch (grasp::TestForceClosure(grasp, polygon.wrench_frame(), friction_angle).decision) {
    case grasp::Decision::kNo:
      return Sense::kNone;
    case grasp::Decision::kTooClose:
      return Sense::kTooClose;
    case grasp::Decision::kYes:
      return a.n.dot(b.p - a.p) > 0 ? Sense::kSqueezing : Sense::kStretching;
  }
  return Sense::kNone;
}

ContactGrid::ContactGrid(const object::Polygon& polygon, double friction_angle, int lines,
                         std::uint64_t seed)
    : polygon_(polygon), friction_angle_(friction_angle) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> within(0.02, 0.98);
  double length = 0;
  for (FaceIndex e{0}; e < polygon.face_count(); ++e) length += polygon.face_measure(e);
  int edge = 0;
  for (const auto& ring : polygon.rings()) {
    const int first = line_count();
    for (std::size_t k = 0; k < ring.size(); ++k, ++edge) {
      const int count = std::max(
          kLeastLines,
          static_cast<int>(std::ceil(lines * polygon.face_measure(FaceIndex(edge)) / length)));
      for (int i = 0; i < count; ++i) {
        lines_.push_back(ContactOn(polygon, edge, (i + within(engine)) / count));
      }
    }
    for (int i = first; i < line_count(); ++i) next_.push_back(i + 1);
    next_.back() = first;
  }
  const int n = line_count();
  sense_.assign(static_cast<std::size_t>(n) * n, Sense::kNone);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      if (lines_[i].face == lines_[j].face) continue;
      sense_[i * n + j] = sense_[j * n + i] =
          SenseOf(polygon, friction_angle, lines_[i], lines_[j]);
    }
  }
  JoinCells();
}

void ContactGrid::JoinCells() {
  const int n = line_count();
  std::vector<std::array<int, 2>> joined;
  std::map<std::tuple<int, int, Sense>, int> first_of;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Sense s = sense(i, j);
      if (!IsGrasp(s)) continue;
      const int cell = i * n + j;
      joined.push_back({cell, j * n + i});
      joined.push_back(
          {cell, first_of.try_emplace({lines_[i].face, lines_[j].face, s}, cell).first->second});
      const int k = next_[i];
      if (lines_[k].face == lines_[i].face || sense(k, j) != s) continue;
      const Sense before =
          SenseOf(polygon_, friction_angle_, ContactOn(polygon_, lines_[i].face, 1), lines_[j]);
      const Sense after =
          SenseOf(polygon_, friction_angle_, ContactOn(polygon_, lines_[k].face, 0), lines_[j]);
      if (before == s && after == s) joined.push_back({cell, k * n + j});
    }
  }
  const search::Components components = search::ComponentsOfEdges(n * n, joined);
  component_.assign(components.of_vertex.size(), -1);
  std::vector<int> number(components.count(), -1);
  for (int cell = 0; cell < n * n; ++cell) {
    if (!IsGrasp(sense_[cell])) continue;
    int& own = number[components.of_vertex[cell]];
    if (own < 0) own = component_count_++;
    component_[cell] = own;
  }
}

GridComparison CompareWithGrid(const object::Polygon& polygon, const ContourGraph& graph,
                               const ContactGrid& grid) {
  GridComparison result;
  const double rounding = kOutlineRounding * polygon.diameter();
  const Boundary& boundary = graph.boundary();
  std::vector<std::vector<Vector2d>> outlines;
  for (PieceIndex p{0}; p < std::ssize(graph.pieces()); ++p) {
    outlines.push_back(PieceOutline(graph, p));
  }
  std::vector<int> set_of(grid.component_count(), -1);
  std::vector<std::set<int>> on_line(grid.line_count());
  const auto fail = [&](int i, int j, const std::string& what) {
    constexpr std::size_t kEnough = 10;
    if (result.failures.size() >= kEnough) return;
    const grasp::Contact& a = grid.line(i);
    const grasp::Contact& b = grid.line(j);
    result.failures.push_back("edges " + std::to_string(a.face) + ' ' + std::to_string(b.face) +
                              " at " + std::to_string(boundary.PlaceOf(a)) + ' ' +
                              std::to_string(boundary.PlaceOf(b)) + ": " + what);
  };
  for (int i = 0; i < grid.line_count(); ++i) {
    for (int j = i + 1; j < grid.line_count(); ++j) {
      const grasp::Contact& a = grid.line(i);
      const grasp::Contact& b = grid.line(j);
      const Sense sense = grid.sense(i, j);
      ++result.pairs;
      if (sense == Sense::kTooClose) {
        ++result.too_close;
        continue;
      }
      // Lines are sorted by edge.
      const Vector2d place(boundary.PlaceOf(a), boundary.PlaceOf(b));
      std::vector<PieceIndex> in;
      bool deep = false;
      for (const PieceIndex piece : graph.PiecesOn(a.face, b.face)) {
        const double depth = DepthIn(outlines[piece], place, rounding);
        if (depth >= -rounding) in.push_back(piece);
        deep = deep || depth > rounding;
      }
      if (!IsGrasp(sense)) {
        if (deep) fail(i, j, "no grasp, but inside a piece");
        continue;
      }
      ++result.grasps;
      if (in.size() != 1) {
        fail(i, j, "a grasp inside " + std::to_string(in.size()) + " pieces");
        continue;
      }
      if (graph.pieces()[in[0]].stretching != (sense == Sense::kStretching)) {
        fail(i, j, "a grasp in a piece of the other sense");
      }
      const int set = graph.set_of(in[0]);
      int& known = set_of[grid.component(i, j)];
      if (known >= 0 && known != set) fail(i, j, "a component in two sets");
      known = set;
      on_line[i].insert(set);
      on_line[j].insert(set);
    }
  }
  std::vector<int> components(graph.vertex_count());
  for (const int set : set_of) {
    if (set >= 0) ++components[set];
  }
  for (const int count : components) {
    if (count == 0) ++result.missed_sets;
    if (count > 0) ++result.sets;
    if (count > 1) ++result.split_sets;
  }
  std::set<std::pair<int, int>> found;
  for (const std::set<int>& sets : on_line) {
    for (const int v : sets) {
      for (const int w : sets) {
        if (v < w) found.insert({v, w});
      }
    }
  }
  std::set<std::pair<int, int>> switches;
  for (const auto& [v, w] : graph.switches()) switches.insert(std::minmax(v, w));
  for (const auto& [v, w] : found) {
    if (switches.contains({v, w})) continue;
    result.failures.push_back("sets " + std::to_string(v) + ' ' + std::to_string(w) +
                              " share a line and are not joined");
  }
  result.switches = static_cast<int>(found.size());
  result.missed_switches = static_cast<int>(switches.size()) - result.switches;
  return result;
}

}  // namespace regrasp::contour
