#include "render/figures/contact_space_map.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "render/figures/contact_space_unfolding.h"

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

Vector2d Mirrored(const Vector2d& p) { return {p.y(), p.x()}; }

SpaceShape Mirrored(const SpaceShape& shape) {
  SpaceShape mirrored = {{shape.rings[1], shape.rings[0]}, {}};
  for (const Vector2d& p : shape.points) mirrored.points.push_back(Mirrored(p));
  return mirrored;
}

void AddBoth(const SpaceShape& shape, std::vector<SpaceShape>& shapes) {
  shapes.push_back(shape);
  shapes.push_back(Mirrored(shape));
}

std::array<contour::RingIndex, 2> RingsOf(const contour::ContourGraph& graph, sets::SetIndex set) {
  const auto& edges = graph.pieces()[graph.pieces_of(set).front()].edges;
  return {graph.boundary().ring_of(edges[0]), graph.boundary().ring_of(edges[1])};
}

/// The largest square in a set, at an end of an edge of its diagram; of size 0 where there is none.
struct LargestSquare {
  Vector2d centre = Vector2d::Zero();
  double size = 0;
};

LargestSquare FindLargest(const std::vector<contour::DiagramEdge>& diagram) {
  LargestSquare largest;
  for (const contour::DiagramEdge& edge : diagram) {
    if (edge.from_size > largest.size) largest = {edge.from, edge.from_size};
    if (edge.to_size > largest.size) largest = {edge.to, edge.to_size};
  }
  return largest;
}

MapSet MakeSet(contour::SetGeometry& geometry, sets::SetIndex set, std::optional<int> name) {
  const contour::ContourGraph& graph = geometry.graph();
  MapSet made;
  made.set = set;
  made.name = name;
  made.stretching = graph.pieces()[graph.pieces_of(set).front()].stretching;
  const auto rings = RingsOf(graph, set);
  for (const contour::PieceIndex piece : graph.pieces_of(set)) {
    const std::vector<Vector2d>& outline = geometry.OutlineOf(piece);
    if (!outline.empty()) AddBoth({rings, outline}, made.pieces);
  }
  for (const contour::BorderSegment& segment : contour::SetBorder(graph, set)) {
    AddBoth({rings, {segment.from, segment.to}}, made.border);
  }
  if (!name) return made;
  const auto [centre, size] = FindLargest(geometry.DiagramOf(set));
  made.largest = size;
  if (size > 0) made.label_places = {{rings, centre}, {{rings[1], rings[0]}, Mirrored(centre)}};
  return made;
}

/// The path of an align. Where a contact turns from the last edge of a ring to the first its place
/// becomes zero; no edge is as long as half of its ring.
void AddPath(const contour::Boundary& boundary, const std::vector<AxisGrasp>& path,
             std::vector<SpaceShape>& paths) {
  SpaceShape shape;
  const auto finish = [&] {
    if (shape.points.size() > 1) paths.push_back(shape);
    shape.points.clear();
  };
  for (const AxisGrasp& grasp : path) {
    const SpacePoint at = PointOf(boundary, grasp);
    for (int axis = 0; !shape.points.empty() && axis < 2; ++axis) {
      const double jump = std::abs(at.places[axis] - shape.points.back()[axis]);
      if (jump > boundary.perimeter(at.rings[axis]) / 2) finish();
    }
    shape.rings = at.rings;
    shape.points.push_back(at.places);
  }
  finish();
}

}  // namespace

std::string SetName(int k) {
  constexpr int kLetters = 26;
  std::string letters;
  for (int rest = k; rest >= 0; rest = rest / kLetters - 1) {
    letters.insert(letters.begin(), static_cast<char>('A' + rest % kLetters));
  }
  return letters;
}

std::map<sets::SetIndex, int> NameSets(const contour::SetGeometry& geometry,
                                       const std::vector<TrackEntry>& track) {
  std::map<sets::SetIndex, int> names;
  for (const TrackEntry& entry : track) {
    const auto at = geometry.Locate({entry.grasp[0].contact, entry.grasp[1].contact});
    if (!at) continue;
    names.try_emplace(geometry.graph().set_of(at->piece), static_cast<int>(names.size()));
  }
  return names;
}

ContactSpaceMap MapContactSpace(contour::SetGeometry& geometry,
                                const std::vector<TrackEntry>& track) {
  const contour::ContourGraph& graph = geometry.graph();
  ContactSpaceMap map;
  map.set_count = graph.vertex_count();
  std::set<contour::RingIndex> used;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const TrackEntry& entry = track[i];
    map.rests.push_back(PointOf(graph.boundary(), entry.grasp));
    used.insert(map.rests.back().rings.begin(), map.rests.back().rings.end());
    AddPath(graph.boundary(), entry.path, map.paths);
    if (entry.kind == std::string_view("switch")) {
      map.switches.push_back({map.rests[i - 1], map.rests[i], entry.shared_axis});
    }
  }
  map.rings.assign(used.begin(), used.end());
  const std::map<sets::SetIndex, int> names = NameSets(geometry, track);
  for (sets::SetIndex set{0}; set < graph.vertex_count(); ++set) {
    const auto rings = RingsOf(graph, set);
    if (!used.contains(rings[0]) || !used.contains(rings[1])) continue;
    const auto name = names.find(set);
    map.sets.push_back(
        MakeSet(geometry, set, name == names.end() ? std::nullopt : std::optional(name->second)));
  }
  return map;
}

}  // namespace regrasp::render
