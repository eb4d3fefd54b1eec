#include "planner/sets/contour/set_geometry.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "planner/grasp/required_friction_angle.h"

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

double CrossProduct(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Compute twice the area of a convex outline.
double DoubleArea(const std::vector<Vector2d>& outline) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    area += CrossProduct(outline[i] - outline[0], outline[i + 1] - outline[0]);
  }
  return area;
}

/// Map two uniform numbers in [0, 1) to a uniform point of a triangle.
Vector2d PointOfTriangle(const Vector2d& a, const Vector2d& b, const Vector2d& c, double s,
                         double t) {
  if (s + t > 1) return a + (1 - s) * (b - a) + (1 - t) * (c - a);
  return a + s * (b - a) + t * (c - a);
}

}  // namespace

const std::vector<Vector2d>& SetGeometry::OutlineOf(PieceIndex piece) {
  deadline_.Check();
  const auto [known, is_new] = outlines_.try_emplace(piece);
  if (is_new) known->second = PieceOutline(graph_, piece);
  return known->second;
}

const RegionMetric& SetGeometry::MetricOf(sets::SetIndex set) {
  return metrics_.try_emplace(set, graph_, set).first->second;
}

const SetGeometry::Diagram& SetGeometry::FindDiagram(sets::SetIndex set) {
  const auto known = diagrams_.find(set);
  if (known != diagrams_.end()) return known->second;
  Diagram diagram;
  diagram.edges = MetricOf(set).MakeDiagram(deadline_);
  for (const DiagramEdge& edge : diagram.edges) {
    diagram.width = std::max({diagram.width, edge.from_size, edge.to_size});
  }
  return diagrams_.emplace(set, std::move(diagram)).first->second;
}

const std::vector<DiagramEdge>& SetGeometry::DiagramOf(sets::SetIndex set) {
  return FindDiagram(set).edges;
}

double SetGeometry::WidthOf(sets::SetIndex set) { return FindDiagram(set).width; }

double SetGeometry::SizeAt(const PlacedGrasp& grasp) {
  return MetricOf(graph_.set_of(grasp.piece)).SizeAt(grasp.places);
}

double SetGeometry::AngleMarginOf(const PlacedGrasp& grasp) const {
  deadline_.Check();
  const grasp::Grasp contacts = GraspOf(grasp);
  const bool stretching = graph_.pieces()[grasp.piece].stretching;
  const Eigen::Vector3d line = (stretching ? -1 : 1) * (contacts[1].p - contacts[0].p);
  return std::atan(graph_.tangent()) - std::max(grasp::AngleBetween(contacts[0].n, line),
                                                grasp::AngleBetween(contacts[1].n, -line));
}

std::optional<PlaceRange> SetGeometry::RangeOf(PieceIndex piece, int k) {
  const std::vector<Vector2d>& outline = OutlineOf(piece);
  if (outline.empty()) return std::nullopt;
  const auto [low, high] =
      std::ranges::minmax(outline, {}, [&](const Vector2d& p) { return p[k]; });
  if (low[k] >= high[k]) return std::nullopt;
  return PlaceRange{low[k], high[k]};
}

std::optional<PlaceRange> SetGeometry::SliceOf(PieceIndex piece, int k, double place) {
  const std::vector<Vector2d>& outline = OutlineOf(piece);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& a = outline[i];
    const Vector2d& b = outline[(i + 1) % outline.size()];
    if (std::min(a[k], b[k]) > place || std::max(a[k], b[k]) < place) continue;
    const double share = a[k] == b[k] ? 0 : (place - a[k]) / (b[k] - a[k]);
    for (const double at : {share, a[k] == b[k] ? 1 : share}) {
      const double other = a[1 - k] + at * (b[1 - k] - a[1 - k]);
      low = std::min(low, other);
      high = std::max(high, other);
    }
  }
  if (!(low < high)) return std::nullopt;
  return PlaceRange{low, high};
}

std::optional<PlacedGrasp> SetGeometry::Draw(sets::SetIndex set, RandomStream& random) {
  double total = 0;
  for (const PieceIndex piece : graph_.pieces_of(set)) total += DoubleArea(OutlineOf(piece));
  double left = total * random.Uniform();
  const double s = random.Uniform();
  const double t = random.Uniform();
  for (const PieceIndex piece : graph_.pieces_of(set)) {
    const std::vector<Vector2d>& outline = OutlineOf(piece);
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
      left -= CrossProduct(outline[i] - outline[0], outline[i + 1] - outline[0]);
      if (left < 0) {
        return PlacedGrasp{piece, PointOfTriangle(outline[0], outline[i], outline[i + 1], s, t)};
      }
    }
  }
  return std::nullopt;
}

std::optional<PlacedGrasp> SetGeometry::Locate(const grasp::Grasp& grasp) const {
  const Boundary& boundary = graph_.boundary();
  const bool ascending = grasp[0].face < grasp[1].face;
  const grasp::Contact& first = grasp[ascending ? 0 : 1];
  const grasp::Contact& second = grasp[ascending ? 1 : 0];
  const bool stretching = first.n.dot(second.p - first.p) < 0;
  for (const PieceIndex piece : graph_.PiecesOn(first.face, second.face)) {
    if (graph_.pieces()[piece].stretching != stretching) continue;
    return PlacedGrasp{piece, {boundary.PlaceOf(first), boundary.PlaceOf(second)}};
  }
  return std::nullopt;
}

grasp::Grasp SetGeometry::GraspOf(const PlacedGrasp& grasp) const {
  const auto& [a, b] = graph_.pieces()[grasp.piece].edges;
  const Boundary& boundary = graph_.boundary();
  return {boundary.ContactAt(a, grasp.places[0]), boundary.ContactAt(b, grasp.places[1])};
}

using Eigen::Vector2d;

namespace {

/// Straightening of the path: usable fraction of each passage about its middle, and number of
/// rounds. More rounds move the path by less than a hundredth of a passage.
constexpr double kUsedShare = 0.5;
constexpr int kPullRounds = 30;

/// Smallest width of an admitted passage, divided by that of the narrowest passage of the widest
/// path.
constexpr double kWideShare = 0.5;

/// Smallest margin by which lengths are divided, rad.
constexpr double kLeastMargin = 1e-6;

/// Step through a passage.
struct Crossing {
  PassageIndex passage;
  bool forward;  ///< direction: from the first piece to the second
  PlaceRange range;
  double place;  ///< place of the fixed contact
};

/// Search state of a passage.
struct Reached {
  double cost = std::numeric_limits<double>::infinity();
  PassageIndex previous;  ///< invalid at the start
  bool forward = true;
  double hurry = 0;   ///< 1 / width; 0 if it is not computed yet
  bool done = false;  ///< whether its cheapest path is known, or it is too narrow
};

class Router {
 public:
  Router(SetGeometry& geometry, const PlacedGrasp& from, const PlacedGrasp& to)
      : geometry_(geometry), graph_(geometry.graph()), from_(from), to_(to) {}

  std::vector<PlacedGrasp> Find() {
    std::vector<Crossing> crossings = FindCrossings();
    for (int round = 0; round < kPullRounds; ++round) Pull(crossings);
    std::vector<PlacedGrasp> route = {from_};
    for (const Crossing& crossing : crossings) {
      route.push_back(Side(crossing, true));
      route.push_back(Side(crossing, false));
    }
    route.push_back(to_);
    return route;
  }

 private:
  [[nodiscard]] PieceIndex PieceOf(const Crossing& c, bool before) const {
    return graph_.passages()[c.passage].pieces[before == c.forward ? 0 : 1];
  }

  /// Return the index of the contact that passes the vertex, in the piece on that side.
  [[nodiscard]] int TurningOf(const Crossing& c, bool before) const {
    return graph_.pieces()[PieceOf(c, before)].edges[0] == graph_.passages()[c.passage].other ? 1
                                                                                              : 0;
  }

  /// Return the grasp at a crossing, before or after the vertex.
  [[nodiscard]] PlacedGrasp Side(const Crossing& c, bool before) const {
    const PiecePassage& passage = graph_.passages()[c.passage];
    const Boundary& boundary = graph_.boundary();
    const int turning = TurningOf(c, before);
    PlacedGrasp grasp = {PieceOf(c, before), {}};
    grasp.places[turning] = before == c.forward ? boundary.end(passage.edge)
                                                : boundary.begin(boundary.next(passage.edge));
    grasp.places[1 - turning] = c.place;
    return grasp;
  }

  [[nodiscard]] Crossing MakeCrossing(PassageIndex passage, bool forward) const {
    const PlaceRange range = PassageRange(graph_, graph_.passages()[passage]);
    return {passage, forward, range, (range.low + range.high) / 2};
  }

  /// Return the angle margin in the middle of a passage, for the normals of both sides, rad.
  [[nodiscard]] double WidthOf(PassageIndex passage) const {
    const Crossing crossing = MakeCrossing(passage, true);
    return std::min(geometry_.AngleMarginOf(Side(crossing, true)),
                    geometry_.AngleMarginOf(Side(crossing, false)));
  }

  /// Return the width of the narrowest passage of the widest path. Passages are added from the
  /// widest on until start and goal are connected.
  [[nodiscard]] double WidestWidth() const {
    std::vector<std::pair<double, PassageIndex>> passages;
    for (const PieceIndex piece : graph_.pieces_of(graph_.set_of(from_.piece))) {
      for (const PassageIndex passage : graph_.passages_at(piece)) {
        if (graph_.passages()[passage].pieces[0] != piece) continue;
        passages.emplace_back(WidthOf(passage), passage);
      }
    }
    std::ranges::sort(passages, std::greater<>());
    boost::disjoint_sets_with_storage<> joined(graph_.pieces().size());
    for (const auto& [width, passage] : passages) {
      const auto& [a, b] = graph_.passages()[passage].pieces;
      joined.union_set(int{a}, int{b});
      if (joined.find_set(int{from_.piece}) == joined.find_set(int{to_.piece})) return width;
    }
    return 0;
  }

  /// Return 1 / margin of a grasp.
  [[nodiscard]] double Hurry(const PlacedGrasp& grasp) const {
    return 1 / std::max(geometry_.AngleMarginOf(grasp), kLeastMargin);
  }

  /// Find the crossings of the cheapest path, in order.
  std::vector<Crossing> FindCrossings() {
    if (from_.piece == to_.piece) return {};
    const double widest = WidestWidth();
    least_width_ = widest > 0 ? kWideShare * widest : widest;
    Relax(from_, Hurry(from_), 0, {});
    std::vector<Crossing> crossings;
    for (PassageIndex passage = FindLastPassage(); passage.valid();
         passage = reached_[passage].previous) {
      crossings.push_back(MakeCrossing(passage, reached_[passage].forward));
    }
    std::ranges::reverse(crossings);
    return crossings;
  }

  /// Find the last passage of the cheapest path, which ends in the goal's piece.
  PassageIndex FindLastPassage() {
    const double goal_hurry = Hurry(to_);
    double best = std::numeric_limits<double>::infinity();
    PassageIndex last;
    while (!queue_.empty()) {
      const auto [cost, passage] = queue_.top();
      queue_.pop();
      if (cost >= best) break;
      Reached& entry = reached_[passage];
      if (entry.done) continue;
      entry.done = true;
      const PlacedGrasp at = Side(MakeCrossing(passage, entry.forward), false);
      if (at.piece == to_.piece) {
        const double total = cost + Cost(at, entry.hurry, to_, goal_hurry);
        if (total < best) {
          best = total;
          last = passage;
        }
      }
      Relax(at, entry.hurry, cost, passage);
    }
    return last;
  }

  /// Update the costs of all passages from a grasp's piece, except the previous one.
  void Relax(const PlacedGrasp& at, double hurry, double cost, PassageIndex previous) {
    for (const PassageIndex next : graph_.passages_at(at.piece)) {
      if (next == previous) continue;
      Reached& entry = reached_[next];
      if (!IsOpen(next, entry)) continue;
      const bool forward = graph_.passages()[next].pieces[0] == at.piece;
      const PlacedGrasp there = Side(MakeCrossing(next, forward), true);
      const double total = cost + Cost(at, hurry, there, entry.hurry);
      if (total >= entry.cost) continue;
      entry = {total, previous, forward, entry.hurry, false};
      queue_.emplace(total, next);
    }
  }

  /// Return whether a passage is wide enough and its cheapest path is not known yet.
  [[nodiscard]] bool IsOpen(PassageIndex passage, Reached& entry) const {
    if (!entry.done && entry.hurry == 0) {
      const double width = WidthOf(passage);
      entry.done = width < least_width_;
      entry.hurry = 1 / std::max(width, kLeastMargin);
    }
    return !entry.done;
  }

  /// Return the length between two grasps divided by their margins.
  [[nodiscard]] static double Cost(const PlacedGrasp& a, double hurry_a, const PlacedGrasp& b,
                                   double hurry_b) {
    return (b.places - a.places).norm() * (hurry_a + hurry_b) / 2;
  }

  /// Move every crossing towards the straight line between its neighbours.
  void Pull(std::vector<Crossing>& crossings) const {
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      Crossing& c = crossings[i];
      const PlacedGrasp previous = i == 0 ? from_ : Side(crossings[i - 1], false);
      const PlacedGrasp next = i + 1 == crossings.size() ? to_ : Side(crossings[i + 1], true);
      const int turning_before = TurningOf(c, true);
      const int turning_after = TurningOf(c, false);
      const double to_line =
          std::abs(Side(c, true).places[turning_before] - previous.places[turning_before]);
      const double from_line =
          std::abs(Side(c, false).places[turning_after] - next.places[turning_after]);
      if (to_line + from_line <= 0) continue;
      const double share = to_line / (to_line + from_line);
      const double straight = (1 - share) * previous.places[1 - turning_before] +
                              share * next.places[1 - turning_after];
      const double margin = (1 - kUsedShare) / 2 * (c.range.high - c.range.low);
      c.place = std::clamp(straight, c.range.low + margin, c.range.high - margin);
    }
  }

  SetGeometry& geometry_;
  const ContourGraph& graph_;
  const PlacedGrasp& from_;
  const PlacedGrasp& to_;
  double least_width_ = 0;  ///< smallest width of admitted passages
  std::map<PassageIndex, Reached> reached_;
  using Entry = std::tuple<double, PassageIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;  ///< passages by cost
};

}  // namespace

std::vector<PlacedGrasp> FindAlignRoute(SetGeometry& geometry, const PlacedGrasp& from,
                                        const PlacedGrasp& to) {
  if (from == to) return {from};
  return Router(geometry, from, to).Find();
}

}  // namespace regrasp::contour
