#include "planner/sets/contour/contour_graph.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/sets/contour/grasp_pieces.h"
#include "planner/sets/contour/projection_sweep.h"

namespace regrasp::contour {

namespace {

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Lists of what belongs to each of `owners`, one after the other.
struct Grouping {
  std::vector<int> members;
  std::vector<int> first;
};

/// @param owner_of  the owner of the i-th entry, whose member is member_of(i).
template <class OwnerOf, class MemberOf>
Grouping Group(int owners, int entries, const OwnerOf& owner_of, const MemberOf& member_of) {
  Grouping grouping{std::vector<int>(entries), std::vector<int>(owners + 1)};
  for (int i = 0; i < entries; ++i) ++grouping.first[owner_of(i) + 1];
  for (int o = 0; o < owners; ++o) grouping.first[o + 1] += grouping.first[o];
  std::vector<int> next(grouping.first.begin(), grouping.first.end() - 1);
  for (int i = 0; i < entries; ++i) grouping.members[next[owner_of(i)]++] = member_of(i);
  return grouping;
}

std::int64_t CountCombinations(const std::vector<GraspPiece>& pieces) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i == 0 || pieces[i].edges != pieces[i - 1].edges) ++count;
  }
  return count;
}

}  // namespace

ContourGraph::ContourGraph(const object::Polygon& polygon, double half_angle,
                           const Deadline& deadline)
    : boundary_(polygon), tangent_(std::tan(half_angle)) {
  if (!(half_angle > 0 && half_angle < std::numbers::pi / 2)) {
    throw std::invalid_argument("the friction half-angle is not in (0, pi/2)");
  }
  const polygon::IntervalScope scope;
  const auto begin = std::chrono::steady_clock::now();
  const polygon::EdgeTable edges(polygon, tangent_);
  const auto candidates = polygon::FindTwoFingerCandidates(edges, deadline);
  candidates_ = std::ssize(candidates);
  pieces_ = FindPieces(edges, candidates, deadline);
  combinations_ = CountCombinations(pieces_);
  passages_ = FindPassages(edges, boundary_, pieces_, deadline);
  GroupPieces();
  vertex_seconds_ = SecondsSince(begin);
  const auto middle = std::chrono::steady_clock::now();
  switches_ = FindOverlaps(
      edges, boundary_, pieces_, vertex_count(), [&](int set) { return pieces_of(set); }, deadline);
  neighbours_.resize(vertex_count());
  for (const auto& [a, b] : switches_) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  for (std::vector<int>& list : neighbours_) std::sort(list.begin(), list.end());
  edge_seconds_ = SecondsSince(middle);
}

void ContourGraph::GroupPieces() {
  const int count = static_cast<int>(pieces_.size());
  search::Components sets = search::FindComponents(
      count, static_cast<int>(passages_.size()),
      [&](int passage) { return std::span<const int>(passages_[passage].pieces); });
  set_of_ = std::move(sets.of_vertex);
  Grouping by_set = Group(
      sets.count(), count, [&](int piece) { return set_of_[piece]; }, std::identity());
  pieces_by_set_ = std::move(by_set.members);
  first_of_set_ = std::move(by_set.first);
  const int ends = 2 * static_cast<int>(passages_.size());
  Grouping by_piece = Group(
      count, ends, [&](int end) { return passages_[end / 2].pieces[end % 2]; },
      [](int end) { return end / 2; });
  passages_by_piece_ = std::move(by_piece.members);
  first_passage_ = std::move(by_piece.first);
}

std::vector<int> ContourGraph::PiecesOn(int edge, int other) const {
  const auto [a, b] = std::minmax(edge, other);
  const std::array<int, 2> edges = {a, b};
  const auto found = std::ranges::equal_range(pieces_, edges, {}, &GraspPiece::edges);
  std::vector<int> pieces;
  for (auto it = found.begin(); it != found.end(); ++it) {
    pieces.push_back(static_cast<int>(it - pieces_.begin()));
  }
  return pieces;
}

search::Components ContourGraph::components() const {
  return search::FindComponents(vertex_count(), static_cast<int>(switches_.size()),
                                [&](int i) { return std::span<const int>(switches_[i]); });
}

void ContourGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  neighbours = neighbours_[vertex];
}

}  // namespace regrasp::contour
