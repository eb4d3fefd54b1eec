#include "planner/roadmap/roadmap.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "planner/grasp/subset_force_closure.h"
#include "planner/roadmap/combination_rank.h"

namespace regrasp {

namespace {

std::vector<std::array<int, 2>> PairsAtSamePoint(const std::vector<Contact>& points,
                                                 double same_point) {
  std::vector<std::array<int, 2>> pairs;
  const int count = static_cast<int>(points.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if ((points[a].p - points[b].p).norm() <= same_point) pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// The triple that is left when one contact of a grasp leaves.
int TripleWithout(const Quadruple& vertex, int left_out) {
  std::array<int, 3> triple;
  std::copy_if(vertex.begin(), vertex.end(), triple.begin(),
               [&](const int& point) { return &point != &vertex[left_out]; });
  return static_cast<int>(CombinationRank(triple));
}

bool Contains(const Quadruple& vertex, int point) {
  return std::find(vertex.begin(), vertex.end(), point) != vertex.end();
}

}  // namespace

Roadmap::Roadmap(std::vector<Contact> points, const WrenchFrame& frame, double half_angle,
                 double same_point)
    : points_(std::move(points)), same_point_pairs_(PairsAtSamePoint(points_, same_point)) {
  vertices_ = ForceClosureSubsets(points_, frame, half_angle);
  std::erase_if(vertices_, [&](const Quadruple& vertex) {
    return std::any_of(same_point_pairs_.begin(), same_point_pairs_.end(), [&](const auto& pair) {
      return Contains(vertex, pair[0]) && Contains(vertex, pair[1]);
    });
  });
  assert(std::is_sorted(vertices_.begin(), vertices_.end()));
  ListByTriples();
}

void Roadmap::ListByTriples() {
  const auto triples = Binomial<3>(static_cast<int>(points_.size()));
  triple_begin_.assign(triples + 1, 0);
  for (const Quadruple& vertex : vertices_) {
    for (int i = 0; i < 4; ++i) ++triple_begin_[TripleWithout(vertex, i) + 1];
  }
  for (std::int64_t t = 0; t < triples; ++t) triple_begin_[t + 1] += triple_begin_[t];
  triple_vertices_.resize(4 * vertices_.size());
  std::vector<int> next = triple_begin_;
  for (int v = 0; v < vertex_count(); ++v) {
    for (int i = 0; i < 4; ++i) triple_vertices_[next[TripleWithout(vertices_[v], i)]++] = v;
  }
}

Grasp Roadmap::grasp(int index) const {
  Grasp grasp;
  for (const int point : vertices_[index]) grasp.push_back(points_[point]);
  return grasp;
}

std::optional<int> Roadmap::Find(std::span<const int> points) const {
  Quadruple vertex;
  if (points.size() != vertex.size()) return std::nullopt;
  std::copy(points.begin(), points.end(), vertex.begin());
  std::sort(vertex.begin(), vertex.end());
  const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
  if (found == vertices_.end() || *found != vertex) return std::nullopt;
  return static_cast<int>(found - vertices_.begin());
}

void Roadmap::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  neighbours.clear();
  for (int i = 0; i < 4; ++i) {
    for (const int other : VerticesWith(TripleWithout(vertices_[vertex], i))) {
      if (other != vertex && !StaysAtPoint(vertex, other)) neighbours.push_back(other);
    }
  }
}

int Roadmap::MinSwitches(int from, int to) const {
  const Quadruple& a = vertices_[from];
  const Quadruple& b = vertices_[to];
  return static_cast<int>(
      std::count_if(a.begin(), a.end(), [&](int point) { return !Contains(b, point); }));
}

std::int64_t Roadmap::candidate_count() const {
  return Binomial<4>(static_cast<int>(points_.size()));
}

std::int64_t Roadmap::edge_count() const {
  std::int64_t count = 0;
  for (int triple = 0; triple < triple_count(); ++triple) count += EdgesWith(triple);
  return count;
}

Components Roadmap::components() const {
  // Being at the same point is an equivalence, so a group with any switch is joined as a whole.
  return FindComponents(vertex_count(), triple_count(), [&](int triple) {
    return EdgesWith(triple) > 0 ? VerticesWith(triple) : std::span<const int>();
  });
}

int Roadmap::triple_count() const { return static_cast<int>(triple_begin_.size()) - 1; }

std::span<const int> Roadmap::VerticesWith(int triple) const {
  const int begin = triple_begin_[triple];
  return std::span(triple_vertices_).subspan(begin, triple_begin_[triple + 1] - begin);
}

bool Roadmap::StaysAtPoint(int vertex, int other) const {
  return std::any_of(same_point_pairs_.begin(), same_point_pairs_.end(), [&](const auto& pair) {
    const auto swaps = [&](int from, int to) {
      return Contains(vertices_[vertex], from) && Contains(vertices_[other], to);
    };
    return swaps(pair[0], pair[1]) || swaps(pair[1], pair[0]);
  });
}

std::int64_t Roadmap::EdgesWith(int triple) const {
  const std::span<const int> group = VerticesWith(triple);
  std::int64_t edges = std::ssize(group) * (std::ssize(group) - 1) / 2;
  if (same_point_pairs_.empty()) return edges;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) edges -= StaysAtPoint(group[i], group[j]) ? 1 : 0;
  }
  return edges;
}

}  // namespace regrasp
