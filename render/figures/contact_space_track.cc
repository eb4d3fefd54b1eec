#include "render/figures/contact_space_track.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <queue>
#include <variant>

namespace regrasp::render {

using Eigen::Vector2d;

namespace {

/// The placement of a piece in the plane: optionally swapped coordinates, and an offset by whole
/// periods.
struct Placement {
  bool swapped = false;
  Vector2d offset = Vector2d::Zero();

  [[nodiscard]] Vector2d operator()(const Vector2d& places) const {
    return (swapped ? Vector2d(places.y(), places.x()) : places) + offset;
  }
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// A neighbour of a piece, with the placement that continues that of the piece.
struct Continuation {
  contour::PieceIndex piece;
  Placement placement;
};

Continuation Continue(const contour::ContourGraph& graph, const contour::PiecePassage& passage,
                      contour::PieceIndex piece, const Placement& placement) {
  const contour::Boundary& boundary = graph.boundary();
  const bool forward = passage.pieces[0] == piece;
  const contour::PieceIndex beyond = passage.pieces[forward ? 1 : 0];
  const FaceIndex next = boundary.next(passage.edge);
  const FaceIndex edge = forward ? passage.edge : next;
  const FaceIndex edge_beyond = forward ? next : passage.edge;
  const int turning = graph.pieces()[piece].edges[0] == edge ? 0 : 1;
  const int axis = placement.swapped ? 1 - turning : turning;
  Continuation found = {beyond, placement};
  found.placement.swapped = graph.pieces()[beyond].edges[axis] != edge_beyond;
  // Zero, or a period at the end of the ring.
  const double step = boundary.end(passage.edge) - boundary.begin(next);
  found.placement.offset[axis] += forward ? step : -step;
  return found;
}

/// Return the line of a passage at the border of one of its pieces.
Segment PassageLine(const contour::ContourGraph& graph, const contour::PiecePassage& passage,
                    contour::PieceIndex piece) {
  const contour::Boundary& boundary = graph.boundary();
  const bool forward = passage.pieces[0] == piece;
  const int other = graph.pieces()[piece].edges[0] == passage.other ? 0 : 1;
  const contour::PlaceRange range = contour::PassageRange(graph, passage);
  Segment line;
  line[0][1 - other] = line[1][1 - other] =
      forward ? boundary.end(passage.edge) : boundary.begin(boundary.next(passage.edge));
  line[0][other] = range.low;
  line[1][other] = range.high;
  return line;
}

class Unfolder {
 public:
  Unfolder(const contour::ContourGraph& graph, contour::PieceIndex root, const Placement& placement)
      : graph_(graph) {
    placements_.emplace(root, placement);
    queue_.push(root);
    while (!queue_.empty()) {
      PlaceNeighbours(queue_.front());
      queue_.pop();
    }
  }

  [[nodiscard]] const std::map<contour::PieceIndex, Placement>& placements() const {
    return placements_;
  }

  [[nodiscard]] std::vector<Segment> FindCuts() const {
    std::vector<Segment> cuts;
    for (const auto& [piece, placement] : placements_) {
      for (const contour::PassageIndex i : graph_.passages_at(piece)) {
        const contour::PiecePassage& passage = graph_.passages()[i];
        const Continuation next = Continue(graph_, passage, piece, placement);
        if (placements_.at(next.piece) == next.placement) continue;
        const Segment line = PassageLine(graph_, passage, piece);
        cuts.push_back({placement(line[0]), placement(line[1])});
      }
    }
    return cuts;
  }

 private:
  void PlaceNeighbours(contour::PieceIndex piece) {
    for (const contour::PassageIndex i : graph_.passages_at(piece)) {
      const Continuation next =
          Continue(graph_, graph_.passages()[i], piece, placements_.at(piece));
      if (placements_.emplace(next.piece, next.placement).second) queue_.push(next.piece);
    }
  }

  const contour::ContourGraph& graph_;
  std::map<contour::PieceIndex, Placement> placements_;
  std::queue<contour::PieceIndex> queue_;
};

}  // namespace

std::vector<contour::BorderSegment> SplitBorder(const contour::ContourGraph& graph,
                                                sets::SetIndex set) {
  const contour::Boundary& boundary = graph.boundary();
  std::vector<contour::BorderSegment> parts;
  for (const contour::BorderSegment& segment : contour::SetBorder(graph, set)) {
    const bool upright = segment.from.x() == segment.to.x();
    if (!upright && segment.from.y() != segment.to.y()) {  // diagonal parts belong to one piece
      parts.push_back(segment);
      continue;
    }
    const int along = upright ? 1 : 0;
    const auto& edges = graph.pieces()[segment.piece].edges;
    const contour::RingIndex ring = boundary.ring_of(edges[along]);
    for (FaceIndex edge = boundary.first_edge(ring); edge < boundary.end_edge(ring); ++edge) {
      contour::BorderSegment part = segment;
      part.from[along] = std::max(segment.from[along], boundary.begin(edge));
      part.to[along] = std::min(segment.to[along], boundary.end(edge));
      if (part.from[along] >= part.to[along] || edge == edges[1 - along]) continue;
      for (const contour::PieceIndex piece : graph.PiecesOn(edges[1 - along], edge)) {
        if (graph.set_of(piece) != set) continue;
        part.piece = piece;
        parts.push_back(part);
      }
    }
  }
  return parts;
}

UnfoldedSet UnfoldSet(contour::SetGeometry& geometry, const contour::PlacedGrasp& root,
                      int upright) {
  assert(upright == 0 || upright == 1);
  const contour::ContourGraph& graph = geometry.graph();
  const sets::SetIndex set = graph.set_of(root.piece);
  const Unfolder unfolder(graph, root.piece, {.swapped = upright == 0});
  UnfoldedSet unfolded;
  for (const auto& [piece, placement] : unfolder.placements()) {
    Outline outline;
    for (const Vector2d& p : geometry.OutlineOf(piece)) outline.push_back(placement(p));
    if (placement.swapped) std::ranges::reverse(outline);
    if (!outline.empty()) unfolded.pieces.push_back(std::move(outline));
  }
  const auto place = [&](contour::PieceIndex piece, const Vector2d& a, const Vector2d& b) {
    const Placement& placement = unfolder.placements().at(piece);
    return Segment{placement(a), placement(b)};
  };
  for (const contour::BorderSegment& part : SplitBorder(graph, set)) {
    unfolded.border.push_back(place(part.piece, part.from, part.to));
  }
  for (const contour::DiagramEdge& edge : geometry.DiagramOf(set)) {
    unfolded.diagram.push_back(place(edge.piece, edge.from, edge.to));
  }
  unfolded.cuts = unfolder.FindCuts();
  return unfolded;
}

namespace {

/// Return the contacts of a grasp on the axes of their fingers.
AxisGrasp OnAxes(const plan::FingerGrasp& grasp, const AxisGrasp& axes) {
  assert(grasp.size() == 2);
  const bool turned = grasp[0].finger == axes[1].finger;
  return {grasp[turned ? 1 : 0], grasp[turned ? 0 : 1]};
}

void Follow(const plan::Align& step, const AxisGrasp& before, TrackEntry& entry) {
  for (const plan::FingerGrasp& waypoint : step.waypoints) {
    entry.path.push_back(OnAxes(waypoint, before));
  }
  entry.grasp = entry.path.back();
}

void Follow(const plan::Switch& step, const AxisGrasp& before, TrackEntry& entry) {
  const plan::FingerGrasp after = plan::GraspAfter({before[0], before[1]}, step);
  assert(after.size() == 2);
  entry.grasp = {after[0], after[1]};
  for (int axis = 0; axis < 2; ++axis) {
    if (plan::FindFinger(after, before[axis].finger) == nullptr) continue;
    entry.shared_axis = axis;
    const bool first = after[0].finger == before[axis].finger;
    entry.grasp[axis] = after[first ? 0 : 1];
    entry.grasp[1 - axis] = after[first ? 1 : 0];
    break;
  }
}

void Follow(const plan::Move& /*step*/, const AxisGrasp& before, TrackEntry& entry) {
  entry.grasp = before;
}

}  // namespace

std::optional<StaticGraspSize> FindOtherThanTwoContacts(const plan::Plan& plan) {
  plan::FingerGrasp grasp = plan.initial;
  plan::EntryIndex entry{0};
  for (const plan::Step& step : plan.steps) {
    if (grasp.size() != 2) break;
    grasp = plan::GraspAfter(grasp, step);
    ++entry;
  }
  if (grasp.size() == 2) return std::nullopt;
  return StaticGraspSize{entry, static_cast<int>(grasp.size())};
}

std::vector<TrackEntry> TrackPlan(const plan::Plan& plan) {
  assert(!FindOtherThanTwoContacts(plan));
  TrackEntry hold;
  hold.kind = "hold";
  hold.grasp = {plan.initial[0], plan.initial[1]};
  if (hold.grasp[0].contact.face > hold.grasp[1].contact.face) {
    std::swap(hold.grasp[0], hold.grasp[1]);
  }
  std::vector<TrackEntry> track = {hold};
  for (const plan::Step& step : plan.steps) {
    TrackEntry entry;
    entry.kind = plan::StepKind(step);
    std::visit([&](const auto& s) { Follow(s, track.back().grasp, entry); }, step);
    track.push_back(std::move(entry));
  }
  return track;
}

SpacePoint PointOf(const contour::Boundary& boundary, const AxisGrasp& grasp) {
  SpacePoint point;
  for (int axis = 0; axis < 2; ++axis) {
    point.rings[axis] = boundary.ring_of(grasp[axis].contact.face);
    point.places[axis] = boundary.PlaceOf(grasp[axis].contact);
  }
  return point;
}

}  // namespace regrasp::render
