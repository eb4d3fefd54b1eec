#include "planner/sets/contour/projection_sweep.h"

#include <algorithm>
#include <deque>
#include <string>

#include "planner/sets/contour/grasp_pieces.h"

namespace regrasp::contour {

namespace {

/// Start or end of a projection.
struct Event {
  /// Position on the edge: at its start, inside it, or at its end.
  enum class Where { kBegin, kInside, kEnd };

  FaceIndex edge;
  Where where = Where::kBegin;
  const polygon::FilteredRange* range = nullptr;  ///< if inside: the event is one end of this range
  bool opens = false;
  sets::SetIndex set;
};

/// Compare two events inside one edge.
int CompareInside(const Event& a, const Event& b) {
  const auto compare = [&](const auto& of_a, const auto& of_b) {
    const auto& x = a.opens ? of_a.low : of_a.high;
    const auto& y = b.opens ? of_b.low : of_b.high;
    return x < y ? -1 : y < x ? 1 : 0;
  };
  try {
    return compare(a.range->by_intervals(), b.range->by_intervals());
  } catch (const CGAL::Uncertain_conversion_exception&) {
  }
  const polygon::ExactScope scope;
  return compare(a.range->exact(), b.range->exact());
}

/// Return the order of two events. Intervals are open, so at one place ends come before starts.
bool IsBefore(const Event& a, const Event& b) {
  if (a.edge != b.edge) return a.edge < b.edge;
  if (a.where != b.where) return a.where < b.where;
  if (a.where == Event::Where::kInside) {
    if (a.range == b.range) return a.opens && !b.opens;
    const int order = CompareInside(a, b);
    if (order != 0) return order < 0;
  }
  return !a.opens && b.opens;
}

class Sweep {
 public:
  Sweep(const polygon::EdgeTable& edges, const Boundary& boundary,
        const std::vector<GraspPiece>& pieces)
      : edges_(edges), boundary_(boundary), pieces_(pieces), covered_(edges.size()) {}

  void AddSet(sets::SetIndex set, std::span<const PieceIndex> pieces) {
    AddCovered(set, pieces);
    for (const PieceIndex piece : pieces) {
      for (int k = 0; k < 2; ++k) AddPartial(set, piece, k);
    }
    for (const FaceIndex edge : covered_edges_) covered_[edge] = 0;
  }

  std::vector<sets::SetPair> Run(int set_count, const Deadline& deadline, const Tell& tell) {
    std::sort(events_.begin(), events_.end(), IsBefore);
    CountedProgress progress(tell, "joining sets along the boundary", std::ssize(events_));
    std::vector<sets::SetPair> pairs;
    std::vector<sets::SetIndex> active;
    std::vector<int> times(set_count);  // number of active projections of each set
    for (const Event& event : events_) {
      deadline.Check();
      progress.Add();
      int& count = times[event.set];
      if (!event.opens) {
        if (--count == 0) active.erase(std::find(active.begin(), active.end(), event.set));
      } else if (++count == 1) {
        for (const sets::SetIndex other : active) {
          pairs.push_back({std::min(event.set, other), std::max(event.set, other)});
        }
        active.push_back(event.set);
      }
    }
    if (tell) tell("ordering " + std::to_string(pairs.size()) + " overlaps of sets");
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  /// Add runs of consecutive edges that a projection covers completely. A large set mainly consists
  /// of them.
  void AddCovered(sets::SetIndex set, std::span<const PieceIndex> pieces) {
    covered_edges_.clear();
    for (const PieceIndex i : pieces) {
      const GraspPiece& piece = pieces_[i];
      for (int k = 0; k < 2; ++k) {
        char& covered = covered_[piece.edges[k]];
        if (covered != 0 || !piece.reaches[2 * k] || !piece.reaches[2 * k + 1]) continue;
        covered = 1;
        covered_edges_.push_back(piece.edges[k]);
      }
    }
    std::sort(covered_edges_.begin(), covered_edges_.end());
    for (std::size_t i = 0; i < covered_edges_.size(); ++i) {
      const FaceIndex edge = covered_edges_[i];
      const bool goes_on = i > 0 && covered_edges_[i - 1] + 1 == edge &&
                           boundary_.ring_of(covered_edges_[i - 1]) == boundary_.ring_of(edge);
      if (goes_on) {
        events_.back().edge = edge;
        continue;
      }
      events_.push_back({edge, Event::Where::kBegin, nullptr, true, set});
      events_.push_back({edge, Event::Where::kEnd, nullptr, false, set});
    }
  }

  void AddPartial(sets::SetIndex set, PieceIndex piece, int k) {
    const FaceIndex edge = pieces_[piece].edges[k];
    if (covered_[edge] != 0) return;
    const auto& reaches = pieces_[piece].reaches;
    const polygon::FilteredRange* range =
        &ranges_.emplace_back(PieceRange(edges_, pieces_[piece], k));
    const auto where = [](bool at_border, Event::Where border) {
      return at_border ? border : Event::Where::kInside;
    };
    events_.push_back({edge, where(reaches[2 * k], Event::Where::kBegin), range, true, set});
    events_.push_back({edge, where(reaches[2 * k + 1], Event::Where::kEnd), range, false, set});
  }

  const polygon::EdgeTable& edges_;
  const Boundary& boundary_;
  const std::vector<GraspPiece>& pieces_;
  std::vector<char> covered_;  ///< whether the current set covers each edge
  std::vector<FaceIndex> covered_edges_;
  std::deque<polygon::FilteredRange> ranges_;
  std::vector<Event> events_;
};

}  // namespace

std::vector<sets::SetPair> FindOverlaps(
    const polygon::EdgeTable& edges, const Boundary& boundary,
    const std::vector<GraspPiece>& pieces, int set_count,
    const std::function<std::span<const PieceIndex>(sets::SetIndex set)>& pieces_of,
    const Deadline& deadline, const Tell& tell) {
  Sweep sweep(edges, boundary, pieces);
  CountedProgress progress(tell, "projecting sets on the boundary", set_count);
  for (sets::SetIndex set{0}; set < set_count; ++set) {
    deadline.Check();
    progress.Add();
    sweep.AddSet(set, pieces_of(set));
  }
  return sweep.Run(set_count, deadline, tell);
}

}  // namespace regrasp::contour
