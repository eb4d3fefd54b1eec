#include "bench/polygon_set_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace regrasp {
namespace {

using Number = CellKernel::FT;
using ExactPoint = CellKernel::Point_2;
using ExactVector = CellKernel::Vector_2;
using Region = CGAL::Polygon_2<CellKernel>;

struct ExactEdge {
  ExactPoint a;
  ExactPoint b;
  ExactVector along;
  ExactVector normal;  ///< inward normal, with the length of `along`
};

ExactEdge MakeExactEdge(const object::Polygon& polygon, int edge) {
  const auto [a, b] = polygon.edge(FaceIndex(edge));
  const ExactPoint pa(a.x(), a.y());
  const ExactPoint pb(b.x(), b.y());
  const ExactVector along = pb - pa;
  return {pa, pb, along, along.perpendicular(CGAL::COUNTERCLOCKWISE)};
}

CGAL::Sign CrossSign(const ExactVector& a, const ExactVector& b) {
  return CGAL::sign(a.x() * b.y() - a.y() * b.x());
}

/// Return true if the gap from a to b, which is known to be in (0, π), is less than π − 2φ; or
/// equal, if `closed`.
bool GapIsSmall(const ExactVector& a, const ExactVector& b, const Number& tangent, bool closed) {
  const ExactVector lower = a + tangent * a.perpendicular(CGAL::CLOCKWISE);
  const ExactVector upper = b + tangent * b.perpendicular(CGAL::COUNTERCLOCKWISE);
  const CGAL::Sign sign = CrossSign(lower, upper);
  return closed ? sign != CGAL::NEGATIVE : sign == CGAL::POSITIVE;
}

/// Return bounds slightly below and above tan φ*, if doubles can resolve it.
std::array<double, 2> GuessesOfLimit(const object::Polygon& polygon,
                                     const std::array<int, 3>& edges) {
  std::array<double, 3> angles;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d n = polygon.inward_normal(FaceIndex(edges[k]));
    angles[k] = std::atan2(n.y(), n.x());
  }
  std::sort(angles.begin(), angles.end());
  const double gap = std::max(
      {angles[1] - angles[0], angles[2] - angles[1], 2 * std::numbers::pi + angles[0] - angles[2]});
  constexpr double kAngleRounding = 1e-14;
  const double limit = (std::numbers::pi - gap) / 2;
  return {std::tan(std::max(0.0, limit - kAngleRounding)), std::tan(limit + kAngleRounding)};
}

/// Return tan φ*, rounded down to a double, for normals that positively span but do not
/// `too_large`-positively span.
double LimitTangent(const object::Polygon& polygon, const std::array<int, 3>& edges,
                    double too_large) {
  // Positive doubles have the same order as their bits.
  auto low = std::bit_cast<std::uint64_t>(0.0);
  auto high = std::bit_cast<std::uint64_t>(too_large);
  for (const double guess : GuessesOfLimit(polygon, edges)) {
    const auto bits = std::bit_cast<std::uint64_t>(guess);
    if (bits <= low || bits >= high) continue;
    (NormalsSpan(polygon, edges, guess, true) ? low : high) = bits;
  }
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (NormalsSpan(polygon, edges, std::bit_cast<double>(middle), true) ? low : high) = middle;
  }
  return std::bit_cast<double>(low);
}

template <class Tangent>
std::vector<SetCandidate> FindCandidates(const object::Polygon& polygon, const Tangent& tangent) {
  std::vector<SetCandidate> candidates;
  const int n = polygon.face_count();
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        const std::optional<double> t = tangent(std::array{i, j, k});
        if (t) candidates.push_back({{i, j, k}, *t});
      }
    }
  }
  return candidates;
}

int CommonEdges(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  int count = 0;
  for (const int edge : a) count += static_cast<int>(std::count(b.begin(), b.end(), edge));
  return count;
}

}  // namespace

bool NormalsSpan(const object::Polygon& polygon, const std::array<int, 3>& edges, double tangent,
                 bool closed) {
  std::array<ExactVector, 3> n;
  for (int k = 0; k < 3; ++k) n[k] = MakeExactEdge(polygon, edges[k]).normal;
  if (CrossSign(n[0], n[1]) == CGAL::NEGATIVE) std::swap(n[1], n[2]);
  for (int k = 0; k < 3; ++k) {
    const ExactVector& next = n[(k + 1) % 3];
    if (CrossSign(n[k], next) != CGAL::POSITIVE) return false;
    if (!GapIsSmall(n[k], next, Number(tangent), closed)) return false;
  }
  return true;
}

std::vector<SetCandidate> FindUniformCandidates(const object::Polygon& polygon,
                                                double friction_angle) {
  const double tangent = std::tan(friction_angle);
  return FindCandidates(polygon, [&](const auto& edges) -> std::optional<double> {
    if (!NormalsSpan(polygon, edges, tangent)) return std::nullopt;
    return tangent;
  });
}

std::vector<SetCandidate> FindAdaptiveCandidates(const object::Polygon& polygon,
                                                 double friction_angle) {
  const double tangent = std::tan(friction_angle);
  return FindCandidates(polygon, [&](const auto& edges) -> std::optional<double> {
    if (!NormalsSpan(polygon, edges, 0)) return std::nullopt;
    if (NormalsSpan(polygon, edges, tangent, true)) return tangent;
    return LimitTangent(polygon, edges, tangent);
  });
}

CellSet SeeingEdge(const object::Polygon& polygon, int edge, double tangent, double reach) {
  const ExactEdge e = MakeExactEdge(polygon, edge);
  const Number t(tangent);
  const Number h(reach);
  const ExactVector right = h * (e.normal + t * e.along);
  const ExactVector left = h * (e.normal - t * e.along);
  Region hexagon;
  for (const ExactPoint& corner : {e.a, e.a - right, e.b - left, e.b, e.b + right, e.a + left}) {
    hexagon.push_back(corner);
  }
  return CellSet(hexagon);
}

std::vector<SetCell> FindSetCells(const object::Polygon& polygon,
                                  const std::vector<SetCandidate>& candidates, double reach) {
  std::map<std::pair<int, double>, CellSet> seeing;
  const auto see = [&](int edge, double t) -> const CellSet& {
    const auto found = seeing.find({edge, t});
    if (found != seeing.end()) return found->second;
    return seeing.emplace(std::pair(edge, t), SeeingEdge(polygon, edge, t, reach)).first->second;
  };
  std::vector<SetCell> cells;
  CellSet seeing_two;
  const SetCandidate* last = nullptr;
  for (const SetCandidate& candidate : candidates) {
    const auto& [edges, t] = candidate;
    if (!last || last->edges[0] != edges[0] || last->edges[1] != edges[1] || last->tangent != t) {
      seeing_two = see(edges[0], t);
      seeing_two.intersection(see(edges[1], t));
      last = &candidate;
    }
    CellSet cell = seeing_two;
    cell.intersection(see(edges[2], t));
    std::vector<CGAL::Polygon_with_holes_2<CellKernel>> components;
    cell.polygons_with_holes(std::back_inserter(components));
    for (auto& component : components) cells.push_back({edges, std::move(component)});
  }
  return cells;
}

std::vector<std::array<int, 2>> FindSetCellSwitches(const std::vector<SetCell>& cells) {
  std::vector<std::array<int, 2>> switches;
  const int n = static_cast<int>(cells.size());
  for (int a = 0; a < n; ++a) {
    CellSet set(cells[a].component);
    for (int b = a + 1; b < n; ++b) {
      if (CommonEdges(cells[a].edges, cells[b].edges) != 2) continue;
      if (set.do_intersect(cells[b].component)) switches.push_back({a, b});
    }
  }
  return switches;
}

}  // namespace regrasp
