#include "planner/sets/contour/grasp_pieces.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <string>

#include "planner/sets/polygon/plane.h"
#include "planner/sets/polygon/polygon_graph.h"

namespace regrasp::contour {

namespace {

/// Result of a decision in doubles.
enum class Verdict { kNone, kAll, kUnknown };

/// Classifies pairs in doubles by the signs of the four borders of their cones at the four corners
/// of the parallelogram of differences.
class CornerFilter {
 public:
  explicit CornerFilter(const polygon::EdgeTable& edges) {
    polygon::Vector2<double> low = edges.ends(FaceIndex(0)).a;
    polygon::Vector2<double> high = low;
    for (FaceIndex e{0}; e < edges.size(); ++e) {
      const polygon::EdgeFrame<double> frame =
          polygon::MakeEdgeFrame<double>(edges.ends(e), edges.tangent());
      frames_.push_back(frame);
      low = {std::min(low.x, frame.a.x), std::min(low.y, frame.a.y)};
      high = {std::max(high.x, frame.a.x), std::max(high.y, frame.a.y)};
    }
    // Differences of coordinates are at most M, borders of cones at most (1 + tan θ) M. A cross
    // product of both has an error of at most a dozen roundings of 2 (1 + tan θ) M².
    constexpr double kRoundings = 32 * std::numeric_limits<double>::epsilon();
    const double extent = std::max(high.x - low.x, high.y - low.y);
    bound_ =
        kRoundings * (1 + edges.tangent()) * extent * extent + std::numeric_limits<double>::min();
  }

  /// Classify a pair, first from outside, then stretching.
  [[nodiscard]] std::array<Verdict, 2> Classify(FaceIndex a, FaceIndex b) const {
    const polygon::EdgeFrame<double>& from = frames_[a];
    const polygon::EdgeFrame<double>& to = frames_[b];
    const std::array<polygon::Vector2<double>, 4> corners = {to.a - from.a, to.b - from.a,
                                                             to.a - from.b, to.b - from.b};
    bool all_positive = true;
    bool all_negative = true;
    bool positive_excluded = false;
    bool negative_excluded = false;
    for (const polygon::Vector2<double>& border : {from.right, -from.left, -to.right, to.left}) {
      double least = std::numeric_limits<double>::infinity();
      double largest = -least;
      for (const polygon::Vector2<double>& corner : corners) {
        const double value = polygon::Cross(border, corner);
        least = std::min(least, value);
        largest = std::max(largest, value);
      }
      all_positive = all_positive && least > bound_;
      all_negative = all_negative && largest < -bound_;
      positive_excluded = positive_excluded || largest < -bound_;
      negative_excluded = negative_excluded || least > bound_;
    }
    const auto verdict = [](bool none, bool all) {
      return none ? Verdict::kNone : all ? Verdict::kAll : Verdict::kUnknown;
    };
    return {verdict(positive_excluded, all_positive), verdict(negative_excluded, all_negative)};
  }

 private:
  std::vector<polygon::EdgeFrame<double>> frames_;
  double bound_ = 0;
};

/// Return the directions from a point to an edge; nullopt if the point is on the edge's line.
template <class NT>
std::optional<polygon::DirectionCone<NT>> ViewOf(const polygon::Vector2<NT>& point,
                                                 const polygon::EdgeFrame<NT>& edge) {
  const polygon::Vector2<NT> a = edge.a - point;
  const polygon::Vector2<NT> b = edge.b - point;
  const int turn = polygon::Sign(polygon::Cross(a, b));
  if (turn == 0) return std::nullopt;
  if (turn > 0) return polygon::DirectionCone<NT>{a, b};
  return polygon::DirectionCone<NT>{b, a};
}

/// Return the directions from a contact on one edge to a contact on another edge that form a grasp.
template <class NT>
std::optional<polygon::DirectionCone<NT>> GraspCone(const polygon::EdgeFrame<NT>& from,
                                                    const polygon::EdgeFrame<NT>& to,
                                                    bool stretching) {
  const auto squeezing = polygon::Intersect(polygon::ConeOf(from), -polygon::ConeOf(to));
  return squeezing && stretching ? -*squeezing : squeezing;
}

/// Return whether more than one contact on `other` forms a grasp with an end of `edge`.
template <class NT>
bool Reaches(const polygon::EdgeFrame<NT>& edge, bool at_end, const polygon::EdgeFrame<NT>& other,
             bool stretching) {
  const auto cone = GraspCone(edge, other, stretching);
  if (!cone) return false;
  const auto view = ViewOf(at_end ? edge.b : edge.a, other);
  return view && polygon::Intersect(*cone, *view);
}

/// Return the sides that a piece reaches (GraspPiece::reaches).
std::array<bool, 4> FindReachedSides(const polygon::EdgeTable& edges, FaceIndex a, FaceIndex b,
                                     bool stretching) {
  std::array<bool, 4> reaches;
  for (int side = 0; side < 4; ++side) {
    const FaceIndex edge = side < 2 ? a : b;
    const FaceIndex other = side < 2 ? b : a;
    reaches[side] = polygon::DecideFiltered([&](auto zero) {
      using NT = decltype(zero);
      return Reaches(edges.frame<NT>(edge), side % 2 == 1, edges.frame<NT>(other), stretching);
    });
  }
  return reaches;
}

/// Return the edge of the piece that differs from `edge`.
FaceIndex OtherEdge(const GraspPiece& piece, FaceIndex edge) {
  return piece.edges[0] == edge ? piece.edges[1] : piece.edges[0];
}

bool ReachesEnd(const GraspPiece& piece, FaceIndex edge, bool at_end) {
  return piece.reaches[(piece.edges[0] == edge ? 0 : 2) + (at_end ? 1 : 0)];
}

/// Return whether two pieces meet in more than a point at the end of `edge`, the start of `next`.
bool Meet(const polygon::EdgeTable& edges, const GraspPiece& before, FaceIndex edge,
          const GraspPiece& after, FaceIndex next) {
  if (!ReachesEnd(before, edge, true) || !ReachesEnd(after, next, false)) return false;
  if (before.full || after.full) return true;
  const FaceIndex other = OtherEdge(before, edge);
  return polygon::DecideFiltered([&](auto zero) {
    using NT = decltype(zero);
    const polygon::EdgeFrame<NT> to = edges.frame<NT>(other);
    const polygon::EdgeFrame<NT> from = edges.frame<NT>(edge);
    const auto first = GraspCone(from, to, before.stretching);
    const auto second = GraspCone(edges.frame<NT>(next), to, before.stretching);
    if (!first || !second) return false;
    const auto both = polygon::Intersect(*first, *second);
    if (!both) return false;
    const auto view = ViewOf(from.b, to);
    return view && polygon::Intersect(*both, *view);
  });
}

/// Index of pieces by their edges.
class PieceFinder {
 public:
  PieceFinder(const std::vector<GraspPiece>& pieces, int edge_count)
      : pieces_(pieces), first_(edge_count + 1) {
    for (const GraspPiece& piece : pieces) ++first_[piece.edges[0] + 1];
    for (int e = 0; e < edge_count; ++e) first_[e + 1] += first_[e];
  }

  /// Return the piece on two edges; nullopt if there is none.
  [[nodiscard]] std::optional<PieceIndex> Find(FaceIndex edge, FaceIndex other,
                                               bool stretching) const {
    const auto [a, b] = std::minmax(edge, other);
    const auto begin = pieces_.begin() + first_[a];
    const auto end = pieces_.begin() + first_[a + 1];
    const auto key = [](const GraspPiece& piece) { return 2 * piece.edges[1] + piece.stretching; };
    const auto found = std::ranges::lower_bound(begin, end, 2 * b + stretching, {}, key);
    if (found == end || key(*found) != 2 * b + stretching) return std::nullopt;
    return PieceIndex(static_cast<int>(found - pieces_.begin()));
  }

 private:
  const std::vector<GraspPiece>& pieces_;
  std::vector<int> first_;
};

}  // namespace

std::vector<GraspPiece> FindPieces(const polygon::EdgeTable& edges,
                                   const std::vector<polygon::TwoFingerCandidate>& candidates,
                                   const Deadline& deadline, const Tell& tell) {
  const CornerFilter filter(edges);
  std::vector<GraspPiece> pieces;
  CountedProgress progress(tell, "testing pairs of edges", std::ssize(candidates));
  for (const polygon::TwoFingerCandidate& pair : candidates) {
    deadline.Check();
    progress.Add();
    const auto verdicts = filter.Classify(pair[0], pair[1]);
    for (const bool stretching : {false, true}) {
      const Verdict verdict = verdicts[stretching ? 1 : 0];
      if (verdict == Verdict::kNone) continue;
      GraspPiece piece = {pair, stretching, verdict == Verdict::kAll, {true, true, true, true}};
      if (!piece.full) {
        piece.reaches = FindReachedSides(edges, pair[0], pair[1], stretching);
        if (piece.reaches == std::array<bool, 4>{}) continue;
      }
      pieces.push_back(piece);
    }
  }
  return pieces;
}

std::vector<PiecePassage> FindPassages(const polygon::EdgeTable& edges, const Boundary& boundary,
                                       const std::vector<GraspPiece>& pieces,
                                       const Deadline& deadline, const Tell& tell) {
  const PieceFinder finder(pieces, edges.size());
  std::vector<PiecePassage> passages;
  CountedProgress progress(tell, "joining grasps across corners", std::ssize(pieces));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    deadline.Check();
    progress.Add();
    const GraspPiece& piece = pieces[i];
    for (const FaceIndex edge : piece.edges) {
      const FaceIndex other = OtherEdge(piece, edge);
      const FaceIndex next = boundary.next(edge);
      if (next == other || !ReachesEnd(piece, edge, true)) continue;
      const auto neighbour = finder.Find(next, other, piece.stretching);
      if (!neighbour || !Meet(edges, piece, edge, pieces[*neighbour], next)) continue;
      passages.push_back({{PieceIndex(static_cast<int>(i)), *neighbour}, edge, other});
    }
  }
  return passages;
}

search::Components FindSets(int piece_count, const std::vector<PiecePassage>& passages) {
  return search::ComponentsOfEdges(piece_count, passages, &PiecePassage::pieces);
}

polygon::FilteredRange PieceRange(const polygon::EdgeTable& edges, const GraspPiece& piece, int k) {
  return polygon::FilteredRange([&edges, piece, k](auto zero) {
    using NT = decltype(zero);
    const polygon::ConvexRegion<NT> region = polygon::MakeTwoFingerRegion<NT>(
        edges.frame<NT>(piece.edges[0]), edges.frame<NT>(piece.edges[1]), piece.stretching);
    return polygon::TwoFingerRange(region, k);
  });
}

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
