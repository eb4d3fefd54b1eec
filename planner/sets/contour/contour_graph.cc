#include "planner/sets/contour/contour_graph.h"

#include <algorithm>
#include <functional>

#include "planner/sets/contour/grasp_pieces.h"

namespace regrasp::contour {

Boundary::Boundary(const object::Polygon& polygon) : polygon_(polygon) {
  int first = 0;
  for (std::size_t ring = 0; ring < polygon.rings().size(); ++ring) {
    const int count = static_cast<int>(polygon.rings()[ring].size());
    first_edges_.emplace_back(first);
    double place = 0;
    for (int k = 0; k < count; ++k) {
      ring_of_.emplace_back(static_cast<int>(ring));
      next_.emplace_back(first + (k + 1) % count);
      begins_.push_back(place);
      place += polygon.face_measure(FaceIndex(first + k));
      ends_.push_back(place);
    }
    perimeters_.push_back(place);
    first += count;
  }
  first_edges_.emplace_back(first);
}

double Boundary::PlaceOf(const grasp::Contact& contact) const {
  const auto [from, to] = polygon_.edge(contact.face);
  const double along = (contact.p - from).dot(to - from) / polygon_.face_measure(contact.face);
  return std::clamp(begin(contact.face) + along, begin(contact.face), end(contact.face));
}

grasp::Contact Boundary::ContactAt(FaceIndex edge, double place) const {
  const auto [from, to] = polygon_.edge(edge);
  // Divided by this difference, the end of an edge is bit-identical to its vertex.
  const double share = std::clamp((place - begin(edge)) / (end(edge) - begin(edge)), 0.0, 1.0);
  return {(1 - share) * from + share * to, polygon_.inward_normal(edge), edge};
}

namespace {

/// Group entries by owner.
/// @param owner_of  function that returns the owner of the i-th entry; member_of(i) is its member.
template <class Owner, class Member, class OwnerOf, class MemberOf>
Grouping<Owner, Member> Group(int owners, int entries, const OwnerOf& owner_of,
                              const MemberOf& member_of) {
  Grouping<Owner, Member> grouping{std::vector<Member>(entries), std::vector<int>(owners + 1)};
  for (int i = 0; i < entries; ++i) ++grouping.first[owner_of(i) + 1];
  for (int o = 0; o < owners; ++o) grouping.first[o + 1] += grouping.first[o];
  std::vector<int> next(grouping.first.begin(), grouping.first.end() - 1);
  for (int i = 0; i < entries; ++i) grouping.members[next[owner_of(i)]++] = Member(member_of(i));
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

ContourGraph::ContourGraph(const object::Polygon& polygon, double friction_angle,
                           const Deadline& deadline, const Tell& tell)
    : boundary_(polygon), tangent_(CheckedTangent(friction_angle)) {
  const polygon::IntervalScope scope;
  BeginVertices();
  const polygon::EdgeTable edges(polygon, tangent_);
  const auto candidates = polygon::FindTwoFingerCandidates(edges, deadline);
  candidates_ = std::ssize(candidates);
  pieces_ = FindPieces(edges, candidates, deadline, tell);
  combinations_ = CountCombinations(pieces_);
  passages_ = FindPassages(edges, boundary_, pieces_, deadline, tell);
  EndVertices(GroupPieces());
  EndEdges(FindOverlaps(
      edges, boundary_, pieces_, vertex_count(), [&](sets::SetIndex set) { return pieces_of(set); },
      deadline, tell));
}

int ContourGraph::GroupPieces() {
  const int count = static_cast<int>(pieces_.size());
  const search::Components components = FindSets(count, passages_);
  set_of_ = std::vector<sets::SetIndex>(components.of_vertex.begin(), components.of_vertex.end());
  pieces_by_set_ = Group<sets::SetIndex, PieceIndex>(
      components.count(), count, [&](int piece) { return set_of_[piece]; }, std::identity());
  passages_by_piece_ = Group<PieceIndex, PassageIndex>(
      count, 2 * static_cast<int>(passages_.size()),
      [&](int end) { return passages_[end / 2].pieces[end % 2]; }, [](int end) { return end / 2; });
  return components.count();
}

std::vector<PieceIndex> ContourGraph::PiecesOn(FaceIndex edge, FaceIndex other) const {
  const auto [a, b] = std::minmax(edge, other);
  const std::array<FaceIndex, 2> edges = {a, b};
  const auto found = std::ranges::equal_range(pieces_, edges, {}, &GraspPiece::edges);
  std::vector<PieceIndex> pieces;
  for (auto it = found.begin(); it != found.end(); ++it) {
    pieces.emplace_back(static_cast<int>(it - pieces_.begin()));
  }
  return pieces;
}

}  // namespace regrasp::contour
