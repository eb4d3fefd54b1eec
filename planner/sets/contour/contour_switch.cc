#include "planner/sets/contour/contour_switch.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace regrasp::contour {

using Eigen::Vector2d;

namespace {

/// Positions between the ends of a range at which grasps are evaluated.
constexpr std::array kShares = {0.5, 0.2, 0.8};

double At(const PlaceRange& range, double share) {
  return range.low + share * (range.high - range.low);
}

/// A piece with one of its edges.
struct OnEdge {
  PieceIndex piece;
  int k;
};

/// Return the pieces of a set by edge.
std::map<FaceIndex, std::vector<OnEdge>> ByEdges(const ContourGraph& graph, sets::SetIndex set) {
  std::map<FaceIndex, std::vector<OnEdge>> by_edges;
  for (const PieceIndex piece : graph.pieces_of(set)) {
    for (int k = 0; k < 2; ++k) by_edges[graph.pieces()[piece].edges[k]].push_back({piece, k});
  }
  return by_edges;
}

PlacedGrasp Place(const OnEdge& on, double place, double other) {
  PlacedGrasp grasp = {on.piece, {}};
  grasp.places[on.k] = place;
  grasp.places[1 - on.k] = other;
  return grasp;
}

struct Scored {
  PlacedGrasp grasp;
  double score = -std::numeric_limits<double>::infinity();
};

/// Return the best of some grasps of a piece with a fixed contact on its k-th edge.
std::optional<Scored> BestOfSlice(SetGeometry& geometry, const OnEdge& on, double place,
                                  const PlacedScore& score) {
  const auto slice = geometry.SliceOf(on.piece, on.k, place);
  if (!slice) return std::nullopt;
  Scored best;
  for (const double share : kShares) {
    const PlacedGrasp grasp = Place(on, place, At(*slice, share));
    const double value = score(grasp);
    if (value > best.score) best = {grasp, value};
  }
  return best;
}

std::optional<PlaceRange> CommonRange(SetGeometry& geometry, const OnEdge& a, const OnEdge& b) {
  const auto first = geometry.RangeOf(a.piece, a.k);
  const auto second = geometry.RangeOf(b.piece, b.k);
  if (!first || !second) return std::nullopt;
  const PlaceRange common = {std::max(first->low, second->low),
                             std::min(first->high, second->high)};
  if (common.low >= common.high) return std::nullopt;
  return common;
}

/// Sizes along an edge of a diagram as a function of a contact's place on one polygon edge.
struct Profile {
  const DiagramEdge* edge;
  int k;
  double low_place, high_place;
  double low_size, high_size;

  [[nodiscard]] double SizeAt(double place) const {
    if (high_place <= low_place) return std::max(low_size, high_size);
    const double share = (place - low_place) / (high_place - low_place);
    return low_size + share * (high_size - low_size);
  }
  [[nodiscard]] double largest() const { return std::max(low_size, high_size); }
  [[nodiscard]] PlacedGrasp GraspAt(double place) const {
    const double from = edge->from[k];
    const double to = edge->to[k];
    double share = from == to ? 0 : std::clamp((place - from) / (to - from), 0.0, 1.0);
    if (from == to && edge->to_size > edge->from_size) share = 1;
    PlacedGrasp grasp = {edge->piece, edge->from + share * (edge->to - edge->from)};
    grasp.places[k] = place;
    return grasp;
  }
};

std::map<FaceIndex, std::vector<Profile>> Profiles(SetGeometry& geometry, sets::SetIndex set) {
  std::map<FaceIndex, std::vector<Profile>> profiles;
  for (const DiagramEdge& edge : geometry.DiagramOf(set)) {
    for (int k = 0; k < 2; ++k) {
      const FaceIndex on = geometry.graph().pieces()[edge.piece].edges[k];
      const bool rising = edge.from[k] <= edge.to[k];
      profiles[on].push_back(
          {&edge, k, rising ? edge.from[k] : edge.to[k], rising ? edge.to[k] : edge.from[k],
           rising ? edge.from_size : edge.to_size, rising ? edge.to_size : edge.from_size});
    }
  }
  return profiles;
}

/// Half-widths of a switch's two regions, smaller one first.
using Sizes = std::pair<double, double>;

/// Maximum number of calls of `accepts`. If it accepts none of them, the largest switch is
/// returned.
constexpr std::size_t kMostAsked = 2000;

/// Smallest ratio of the half-widths. At the end of a diagram edge, one of them may be rounding
/// only.
constexpr double kLeastShare = 1e-9;

class LargestSwitch {
 public:
  void Consider(const Profile& a, const Profile& b) {
    const double low = std::max(a.low_place, b.low_place);
    const double high = std::min(a.high_place, b.high_place);
    if (low > high) return;
    // The minimum of two lines is largest at an end or at their intersection. Points between serve
    // predicates that do not accept it.
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) Add(a, b, low + share * (high - low));
    const double at_low = a.SizeAt(low) - b.SizeAt(low);
    const double at_high = a.SizeAt(high) - b.SizeAt(high);
    if (at_low * at_high < 0) Add(a, b, low + at_low / (at_low - at_high) * (high - low));
  }

  /// Return the largest accepted switch; nullopt if no two edges have a common place.
  [[nodiscard]] std::optional<ContourSwitch> Best(
      const std::function<bool(const ContourSwitch&)>& accepts) {
    if (found_.empty()) return std::nullopt;
    const std::size_t asked = std::min(found_.size(), kMostAsked);
    std::ranges::partial_sort(found_, found_.begin() + static_cast<std::ptrdiff_t>(asked),
                              std::greater<>(), &Found::sizes);
    for (std::size_t i = 0; i < asked; ++i) {
      const ContourSwitch candidate = Make(found_[i]);
      if (accepts(candidate)) return candidate;
    }
    return Make(found_.front());
  }

 private:
  struct Found {
    Sizes sizes;
    const Profile* a = nullptr;
    const Profile* b = nullptr;
    double place = 0;
  };

  void Add(const Profile& a, const Profile& b, double place) {
    const Sizes sizes = std::minmax({a.SizeAt(place), b.SizeAt(place)});
    if (sizes.first > kLeastShare * sizes.second) found_.push_back({sizes, &a, &b, place});
  }

  [[nodiscard]] static ContourSwitch Make(const Found& found) {
    return {found.a->GraspAt(found.place), found.b->GraspAt(found.place)};
  }

  std::vector<Found> found_;
};

}  // namespace

std::optional<ContourSwitch> FindMaxMarginSwitch(SetGeometry& geometry, sets::SetIndex from,
                                                 sets::SetIndex to, const PlacedScore& score) {
  const auto of_from = ByEdges(geometry.graph(), from);
  const auto of_to = ByEdges(geometry.graph(), to);
  std::optional<ContourSwitch> best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (const auto& [edge, sides] : of_from) {
    const auto others = of_to.find(edge);
    if (others == of_to.end()) continue;
    for (const OnEdge& a : sides) {
      for (const OnEdge& b : others->second) {
        const auto common = CommonRange(geometry, a, b);
        if (!common) continue;
        for (const double share : kShares) {
          const double place = At(*common, share);
          const auto before = BestOfSlice(geometry, a, place, score);
          const auto after = BestOfSlice(geometry, b, place, score);
          if (!before || !after) continue;
          const double worse = std::min(before->score, after->score);
          if (worse <= best_score) continue;
          best_score = worse;
          best = {before->grasp, after->grasp};
        }
      }
    }
  }
  return best;
}

std::optional<PlacedGrasp> FindGraspKeeping(SetGeometry& geometry, const PlacedGrasp& given,
                                            sets::SetIndex set, const PlacedScore& score) {
  const ContourGraph& graph = geometry.graph();
  std::optional<Scored> best;
  for (int k = 0; k < 2; ++k) {
    for (const PieceIndex piece : graph.pieces_of(set)) {
      const auto& edges = graph.pieces()[piece].edges;
      const auto on = std::ranges::find(edges, graph.pieces()[given.piece].edges[k]);
      if (on == edges.end()) continue;
      const auto found = BestOfSlice(geometry, {piece, static_cast<int>(on - edges.begin())},
                                     given.places[k], score);
      if (found && (!best || found->score > best->score)) best = found;
    }
  }
  if (!best) return std::nullopt;
  return best->grasp;
}

bool HaveCommonContact(const ContourGraph& graph, const PlacedGrasp& a, const PlacedGrasp& b) {
  for (int k = 0; k < 2; ++k) {
    for (int l = 0; l < 2; ++l) {
      const bool same_edge = graph.pieces()[a.piece].edges[k] == graph.pieces()[b.piece].edges[l];
      if (same_edge && a.places[k] == b.places[l]) return true;
    }
  }
  return false;
}

std::optional<ContourSwitch> FindLargestSwitch(
    SetGeometry& geometry, sets::SetIndex from, sets::SetIndex to,
    const std::function<bool(const ContourSwitch&)>& accepts) {
  const auto of_from = Profiles(geometry, from);
  const auto of_to = Profiles(geometry, to);
  LargestSwitch largest;
  for (const auto& [edge, profiles] : of_from) {
    const auto others = of_to.find(edge);
    if (others == of_to.end()) continue;
    for (const Profile& a : profiles) {
      for (const Profile& b : others->second) largest.Consider(a, b);
    }
  }
  return largest.Best(accepts);
}

}  // namespace regrasp::contour
