#include "planner/object/weld.h"

#include <algorithm>
#include <array>
#include <boost/container_hash/hash.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/facet_triangulation.h"
#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

std::string SizeComplaint(const std::vector<Eigen::Vector3d>& vertices, double diameter) {
  if (!(diameter >= kMinDiameter)) {
    return "all vertices lie within " + FormatDouble(kMinDiameter) + " of each other";
  }
  const auto too_far = [&](const Eigen::Vector3d& v) { return v.norm() > kMaxOffset * diameter; };
  const auto found = std::ranges::find_if(vertices, too_far);
  if (found == vertices.end()) return "";
  return "too far from the origin (" + FormatShort(found->norm()) + ") for an object of diameter " +
         FormatShort(diameter);
}

std::string EdgeComplaint(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double diameter) {
  const double length = (to - from).stableNorm();
  if (length >= kMinEdge * diameter) return "";
  return "shorter (" + FormatShort(length) + ") than " + FormatDouble(kMinEdge) +
         " of the diameter (" + FormatShort(diameter) + "); help: merge its ends";
}

namespace {

std::string FacetName(const std::string& name, std::size_t facet) {
  return name + ": facet " + std::to_string(facet);
}

void CheckIndex(const PolygonSoup& soup, std::size_t facet, int index, const std::string& name) {
  if (index >= 0 && index < std::ssize(soup.vertices)) return;
  throw MeshError(MeshDefect::kIndexOutOfRange,
                  FacetName(name, facet) + ": vertex index " + std::to_string(index) +
                      " must be at least 0 and less than " + std::to_string(soup.vertices.size()) +
                      ", the number of vertices");
}

void CheckCoordinates(const Eigen::Vector3d& vertex, int index, const std::string& name) {
  for (const double x : vertex) {
    if (std::abs(x) <= kMaxCoordinate) continue;  // false for NaN
    throw MeshError(MeshDefect::kNotFinite, name + ": vertex " + std::to_string(index) +
                                                ": the coordinate " + FormatDouble(x) +
                                                " must be finite and of magnitude at most " +
                                                FormatDouble(kMaxCoordinate));
  }
}

}  // namespace

void DropRepeated(std::vector<int>& corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) corners.clear();
}

void DropUnused(WeldedSoup& soup) {
  std::vector<int> number(soup.vertices.size(), -1);
  for (const auto& facet : soup.facets) {
    for (const int v : facet) number[v] = 0;
  }
  int next = 0;
  for (int v = 0; v < std::ssize(soup.vertices); ++v) {
    if (number[v] < 0) continue;
    soup.vertices[next] = soup.vertices[v];
    soup.vertex_in_file[next] = soup.vertex_in_file[v];
    number[v] = next++;
  }
  if (next == std::ssize(soup.vertices)) return;
  soup.vertices.resize(next);
  soup.vertex_in_file.resize(next);
  for (auto& facet : soup.facets) {
    for (int& v : facet) v = number[v];
  }
}

WeldedSoup WeldVertices(const PolygonSoup& soup, const std::string& name) {
  if (soup.facets.empty()) {
    throw MeshError(
        MeshDefect::kEmpty,
        name + ": empty: facets not found" +
            (soup.vertices.empty() ? ""
                                   : ", found only " + std::to_string(soup.vertices.size()) +
                                         " points; help: reconstruct a surface with repair"));
  }
  if (soup.facets.size() > kMaxFacets) {
    throw MeshError(MeshDefect::kTooLarge, name + ": " + std::to_string(soup.facets.size()) +
                                               " facets, limit " + std::to_string(kMaxFacets));
  }
  WeldedSoup welded;
  welded.facets.reserve(soup.facets.size());
  using Coordinates = std::array<double, 3>;
  std::unordered_map<Coordinates, int, boost::hash<Coordinates>> at_coordinates;
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    std::vector<int> corners;
    for (const int index : soup.facets[f]) {
      CheckIndex(soup, f, index, name);
      CheckCoordinates(soup.vertices[index], index, name);
      // Adding 0 turns −0 into +0, so that printed coordinates and normals have no "-0".
      const Eigen::Vector3d vertex = soup.vertices[index].array() + 0.0;
      const auto [found, is_new] = at_coordinates.try_emplace(
          {vertex.x(), vertex.y(), vertex.z()}, static_cast<int>(welded.vertices.size()));
      if (is_new) {
        welded.vertices.push_back(vertex);
        welded.vertex_in_file.push_back(index);
      }
      corners.push_back(found->second);
    }
    DropRepeated(corners);
    welded.facets.push_back(std::move(corners));
  }
  DropUnused(welded);
  return welded;
}

namespace {

/// Cyclic sequence of corners in canonical order: from its lowest corner towards the lower of the
/// two adjacent ones.
class Cycle {
 public:
  Cycle() = default;
  Cycle(const std::vector<int>& corners, int facet) : corners_(&corners), facet_(facet) {
    const std::size_t size = corners.size();
    start_ = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
    forward_ = corners[(start_ + 1) % size] < corners[(start_ + size - 1) % size];
    for (std::size_t k = 0; k < size; ++k) hash_ = (hash_ ^ std::uint64_t(at(k))) * kPrime;
  }

  [[nodiscard]] int facet() const { return facet_; }
  [[nodiscard]] bool forward() const { return forward_; }

  /// An arbitrary total order, in which equal cycles are adjacent.
  friend std::weak_ordering operator<=>(const Cycle& a, const Cycle& b) {
    const auto rough =
        std::pair(a.hash_, a.corners_->size()) <=> std::pair(b.hash_, b.corners_->size());
    if (rough != 0) return rough;
    for (std::size_t k = 0; k < a.corners_->size(); ++k) {
      if (a.at(k) != b.at(k)) return a.at(k) <=> b.at(k);
    }
    return std::weak_ordering::equivalent;
  }
  friend bool operator==(const Cycle& a, const Cycle& b) { return (a <=> b) == 0; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;  // prime of FNV-1a

  [[nodiscard]] int at(std::size_t k) const {
    const std::size_t size = corners_->size();
    return (*corners_)[(forward_ ? start_ + k : start_ + size - k) % size];
  }

  const std::vector<int>* corners_ = nullptr;
  std::size_t start_ = 0;
  std::uint64_t hash_ = 0xcbf29ce484222325;
  int facet_ = 0;
  bool forward_ = true;
};

}  // namespace

std::vector<RepeatedFacet> FindRepeatedFacets(const std::vector<std::vector<int>>& facets) {
  std::vector<Cycle> cycles;
  for (int f = 0; f < std::ssize(facets); ++f) {
    if (!facets[f].empty()) cycles.emplace_back(facets[f], f);
  }
  std::ranges::stable_sort(cycles, [](const Cycle& a, const Cycle& b) { return a < b; });
  std::vector<RepeatedFacet> repeated;
  for (std::size_t first = 0, i = 1; i < cycles.size(); ++i) {
    if (cycles[i] == cycles[first]) {
      repeated.push_back({cycles[i].facet(), cycles[first].facet(),
                          cycles[i].forward() == cycles[first].forward()});
    } else {
      first = i;
    }
  }
  std::ranges::sort(repeated, {},
                    [](const RepeatedFacet& r) { return std::pair(r.first, r.facet); });
  return repeated;
}

using Eigen::Vector3d;

namespace {

/// Hash grid that finds the first earlier point within a distance of a point.
class NearPoints {
 public:
  NearPoints(const std::vector<Vector3d>& points, double within)
      : points_(points), within_(within) {}

  /// Return the first earlier point within the distance. If there is none, store the point and
  /// return it.
  int FirstNear(int point) {
    const Vector3d& p = points_[point];
    const Cell cell = CellOf(p);
    for (std::int64_t i = 0; i < 27; ++i) {
      const auto found =
          known_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == known_.end()) continue;
      for (const int other : found->second) {
        if ((points_[other] - p).norm() <= within_) return other;
      }
    }
    known_[cell].push_back(point);
    return point;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell CellOf(const Vector3d& p) const {
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / within_)); };
    return {at(p.x()), at(p.y()), at(p.z())};
  }

  const std::vector<Vector3d>& points_;
  double within_;
  std::unordered_map<Cell, std::vector<int>, boost::hash<Cell>> known_;
};

bool WeldBorders(WeldedSoup& soup, double diameter) {
  std::vector<bool> on_border(soup.vertices.size(), false);
  const auto sides = SortedEdgeSides(soup.facets, soup.vertices.size());
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() == 1) on_border[edge[0].low] = on_border[edge[0].high] = true;
  });
  NearPoints near(soup.vertices, kPointTolerance * diameter);
  std::vector<int> becomes(soup.vertices.size());
  bool changed = false;
  for (int v = 0; v < std::ssize(becomes); ++v) {
    becomes[v] = on_border[v] ? near.FirstNear(v) : v;
    changed = changed || becomes[v] != v;
  }
  if (!changed) return false;
  for (auto& facet : soup.facets) {
    for (int& v : facet) v = becomes[v];
    DropRepeated(facet);
  }
  return true;
}

std::vector<bool> FindFlattened(const WeldedSoup& soup) {
  std::vector<bool> flattened;
  std::vector<Vector3d> corners;
  for (const auto& facet : soup.facets) {
    corners.clear();
    for (const int v : facet) corners.push_back(soup.vertices[v]);
    flattened.push_back(!facet.empty() && AreCollinear(corners));
  }
  return flattened;
}

/// Return a sort key that orders the points of any line.
auto Place(const WeldedSoup& soup, int vertex) {
  const Vector3d& p = soup.vertices[vertex];
  return std::tuple(p.x(), p.y(), p.z());
}

/// Collinear vertices of each connected set of polygons without area, in order. They are stored
/// once per set.
class Lines {
 public:
  Lines(const WeldedSoup& soup, const std::vector<EdgeSide>& sides,
        const std::vector<bool>& flattened)
      : joined_(soup.facets.size()) {
    ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
      int first = -1;
      for (const EdgeSide& side : edge) {
        if (!flattened[side.facet]) continue;
        if (first < 0) first = side.facet;
        joined_.union_set(first, side.facet);
      }
    });
    for (int f = 0; f < std::ssize(soup.facets); ++f) {
      if (!flattened[f]) continue;
      std::vector<int>& line = lines_[joined_.find_set(f)];
      line.insert(line.end(), soup.facets[f].begin(), soup.facets[f].end());
    }
    for (auto& [facet, line] : lines_) {
      std::ranges::sort(line, {}, [&](int v) { return Place(soup, v); });
      line.erase(std::unique(line.begin(), line.end()), line.end());
    }
  }

  [[nodiscard]] const std::vector<int>& Of(int facet) { return lines_.at(joined_.find_set(facet)); }

 private:
  boost::disjoint_sets_with_storage<> joined_;
  std::map<std::size_t, std::vector<int>> lines_;
};

using VertexEdge = std::pair<int, int>;  ///< lower vertex first

/// Find the vertices between the ends of each edge of polygons without area, in the order of Place.
/// @returns nullopt if their number exceeds that of all edge sides.
std::optional<std::map<VertexEdge, std::vector<int>>> FindSplits(
    const WeldedSoup& soup, const std::vector<bool>& flattened) {
  const std::vector<EdgeSide> sides = SortedEdgeSides(soup.facets, soup.vertices.size());
  Lines lines(soup, sides, flattened);
  std::map<VertexEdge, std::vector<int>> splits;
  std::size_t count = 0;
  ForEachEdge(sides, [&](std::span<const EdgeSide> edge) {
    const auto on_line = std::ranges::find_if(
        edge, [&](const EdgeSide& side) { return bool(flattened[side.facet]); });
    if (on_line == edge.end() || count > sides.size()) return;
    const std::vector<int>& line = lines.Of(on_line->facet);
    const auto place = [&](int v) { return Place(soup, v); };
    const auto [from, to] = std::minmax({place(on_line->low), place(on_line->high)});
    const auto first = std::ranges::upper_bound(line, from, {}, place);
    const auto last = std::ranges::lower_bound(line, to, {}, place);
    if (first == last) return;
    count += static_cast<std::size_t>(last - first);
    splits[{on_line->low, on_line->high}].assign(first, last);
  });
  if (count > sides.size()) return std::nullopt;
  return splits;
}

/// Drop polygons without area.
///
/// The edges of such a polygon cancel piece by piece. The surface therefore stays closed if its
/// corners are added to the adjacent polygons, on their common edges.
bool DropFlattened(WeldedSoup& soup) {
  const std::vector<bool> flattened = FindFlattened(soup);
  if (std::ranges::find(flattened, true) == flattened.end()) return false;
  const auto splits = FindSplits(soup, flattened);
  if (!splits) return false;
  for (std::size_t f = 0; f < flattened.size(); ++f) {
    std::vector<int> corners;
    for (std::size_t k = 0; !flattened[f] && k < soup.facets[f].size(); ++k) {
      const int from = soup.facets[f][k], to = soup.facets[f][(k + 1) % soup.facets[f].size()];
      corners.push_back(from);
      const auto split = splits->find(std::minmax(from, to));
      if (split == splits->end()) continue;
      const std::vector<int>& between = split->second;
      if (Place(soup, from) < Place(soup, to)) {
        corners.insert(corners.end(), between.begin(), between.end());
      } else {
        corners.insert(corners.end(), between.rbegin(), between.rend());
      }
    }
    soup.facets[f] = std::move(corners);
  }
  return true;
}

/// Drop polygons with equal corners.
///
/// Keeps the first one of the more frequent orientation, and none if both are equally frequent.
bool DropRepeatedFacets(WeldedSoup& soup) {
  const std::vector<RepeatedFacet> repeated = FindRepeatedFacets(soup.facets);
  for (auto first = repeated.begin(), last = first; first != repeated.end(); first = last) {
    last = std::find_if(first, repeated.end(),
                        [&](const RepeatedFacet& r) { return r.first != first->first; });
    const auto same =
        1 + std::count_if(first, last, [](const RepeatedFacet& r) { return r.same_way; });
    const auto opposite = last - first + 1 - same;
    const auto turned =
        std::find_if(first, last, [](const RepeatedFacet& r) { return !r.same_way; });
    const int kept = same > opposite ? first->first : same < opposite ? turned->facet : -1;
    if (kept != first->first) soup.facets[first->first].clear();
    for (auto r = first; r != last; ++r) {
      if (r->facet != kept) soup.facets[r->facet].clear();
    }
  }
  return !repeated.empty();
}

}  // namespace

bool RepairSoup(WeldedSoup& soup, double diameter) {
  const bool welded = WeldBorders(soup, diameter);
  const bool flattened = DropFlattened(soup);
  const bool repeated = DropRepeatedFacets(soup);
  if (!welded && !flattened && !repeated) return false;
  DropUnused(soup);
  return true;
}

}  // namespace regrasp::object
