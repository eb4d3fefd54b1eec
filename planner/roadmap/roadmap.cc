#include "planner/roadmap/roadmap.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/subset_force_closure.h"

namespace regrasp::roadmap {

namespace {

/// Return for each pair of points whether two fingers cannot be at both.
std::vector<bool> FindExcluded(const std::vector<grasp::Contact>& points, double same_point,
                               double finger_radius) {
  const std::size_t count = points.size();
  std::vector<bool> excluded(count * count, false);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (criteria::CanMeet(points[a], points[b], same_point, finger_radius)) continue;
      excluded[a * count + b] = excluded[b * count + a] = true;
    }
  }
  return excluded;
}

/// Return the rank of the triple that remains when one contact of a grasp is released.
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

Roadmap::Roadmap(std::vector<grasp::Contact> points, const object::WrenchFrame& frame,
                 double friction_angle, double same_point, double finger_radius,
                 const Deadline& deadline, const Tell& tell)
    : points_(std::move(points)), excluded_(FindExcluded(points_, same_point, finger_radius)) {
  any_excluded_ = std::find(excluded_.begin(), excluded_.end(), true) != excluded_.end();
  vertices_ = grasp::ForceClosureSubsets(points_, frame, friction_angle, nullptr, deadline, tell);
  deadline.Check();
  if (any_excluded_) {
    std::erase_if(vertices_, [&](const Quadruple& vertex) {
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
          if (ExcludeEachOther(vertex[i], vertex[j])) return true;
        }
      }
      return false;
    });
  }
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

grasp::Grasp Roadmap::grasp(int index) const {
  grasp::Grasp grasp;
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
      if (other != vertex && !IsExcluded(vertex, other)) neighbours.push_back(other);
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

std::int64_t Roadmap::CountEdges(const Deadline& deadline) const {
  std::int64_t count = 0;
  for (int triple = 0; triple < triple_count(); ++triple) {
    deadline.Check();
    count += EdgesWith(triple);
  }
  return count;
}

search::Components Roadmap::FindComponents(const Deadline& deadline) const {
  if (!any_excluded_) {
    return search::FindComponents(vertex_count(), triple_count(), [&](int triple) {
      deadline.Check();
      return VerticesWith(triple);
    });
  }
  // In a group with excluded pairs, a search of the group gives a tree of edges. Each vertex is
  // connected to all remaining vertices that it does not exclude.
  std::vector<std::array<int, 2>> edges;
  for (int triple = 0; triple < triple_count(); ++triple) {
    deadline.Check();
    const std::span<const int> group = VerticesWith(triple);
    std::vector<int> left(group.begin(), group.end());
    std::vector<int> reached;
    while (!left.empty() || !reached.empty()) {
      if (reached.empty()) {
        reached.push_back(left.back());
        left.pop_back();
      }
      const int vertex = reached.back();
      reached.pop_back();
      const auto joined = std::partition(left.begin(), left.end(),
                                         [&](int other) { return IsExcluded(vertex, other); });
      for (auto other = joined; other != left.end(); ++other) {
        edges.push_back({vertex, *other});
        reached.push_back(*other);
      }
      left.erase(joined, left.end());
    }
  }
  return search::FindComponents(vertex_count(), static_cast<int>(edges.size()), [&](int edge) {
    deadline.Check();
    return std::span<const int>(edges[edge]);
  });
}

int Roadmap::triple_count() const { return static_cast<int>(triple_begin_.size()) - 1; }

std::span<const int> Roadmap::VerticesWith(int triple) const {
  const int begin = triple_begin_[triple];
  return std::span(triple_vertices_).subspan(begin, triple_begin_[triple + 1] - begin);
}

bool Roadmap::IsExcluded(int vertex, int other) const {
  if (!any_excluded_) return false;
  const Quadruple& a = vertices_[vertex];
  const Quadruple& b = vertices_[other];
  const auto left = std::find_if_not(a.begin(), a.end(), [&](int p) { return Contains(b, p); });
  const auto taken = std::find_if_not(b.begin(), b.end(), [&](int p) { return Contains(a, p); });
  return left != a.end() && taken != b.end() && ExcludeEachOther(*left, *taken);
}

std::int64_t Roadmap::EdgesWith(int triple) const {
  const std::span<const int> group = VerticesWith(triple);
  std::int64_t edges = std::ssize(group) * (std::ssize(group) - 1) / 2;
  if (!any_excluded_) return edges;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) edges -= IsExcluded(group[i], group[j]) ? 1 : 0;
  }
  return edges;
}

}  // namespace regrasp::roadmap
