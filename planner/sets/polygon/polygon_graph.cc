#include "planner/sets/polygon/polygon_graph.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <chrono>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <stdexcept>

#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/parallel.h"
#include "planner/sets/polygon/two_finger.h"

namespace regrasp::polygon {

namespace {

using Triple = std::array<int, 3>;

struct ConcurrentVertex {
  ConcurrentCandidate candidate;
  FocusComponent component;
};

struct TwoFingerVertex {
  TwoFingerCandidate candidate;
  TwoFingerPart part;
};

struct ParallelVertex {
  Triple edges;
  ParallelComponent component;
};

/// The edges of a polygon that two grasps have in common, by their positions in the first and in
/// the second.
using CommonEdges = boost::container::static_vector<std::pair<int, int>, 3>;

CommonEdges FindCommonEdges(std::span<const int> a, std::span<const int> b) {
  CommonEdges common;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) {
      common.emplace_back(static_cast<int>(i++), static_cast<int>(j++));
    } else {
      ++(a[i] < b[j] ? i : j);
    }
  }
  return common;
}

bool Overlap(const std::vector<FilteredRegion>& a, const std::vector<FilteredRegion>& b) {
  return std::any_of(a.begin(), a.end(), [&](const FilteredRegion& region) {
    return std::any_of(b.begin(), b.end(), [&](const FilteredRegion& other) {
      return FilteredRegion::Overlap(region, other);
    });
  });
}

/// Contact pairs of a vertex, made when first asked for.
class PairCache {
 public:
  template <class Make>
  const std::vector<FilteredRegion>& Get(int k, int l, const Make& make) {
    std::optional<std::vector<FilteredRegion>>& pairs = pairs_[k + l - 1];
    if (!pairs) pairs = make(k, l);
    return *pairs;
  }

 private:
  std::array<std::optional<std::vector<FilteredRegion>>, 3> pairs_;  ///< (0,1), (0,2), (1,2)
};

/// Finds vertices and edges; all inside one IntervalScope.
class GraphBuilder {
 public:
  /// @param deadline  outlives this object.
  GraphBuilder(const object::Polygon& polygon, double tangent, planning::Spanning spanning,
               const Deadline& deadline)
      : spanning_(spanning), edges_(polygon, tangent), deadline_(deadline) {}

  void FindVertices(std::array<GraspTypeCounts, kGraspTypes>& counts) {
    FindConcurrent(counts[static_cast<int>(GraspType::kConcurrent)]);
    FindTwoFinger(counts[static_cast<int>(GraspType::kTwoFinger)]);
    FindParallel(counts[static_cast<int>(GraspType::kParallel)]);
  }

  [[nodiscard]] std::vector<GraspSet> MakeSets() const {
    std::vector<GraspSet> sets;
    for (const ConcurrentVertex& v : concurrent_) {
      GraspSet set{GraspType::kConcurrent, {}, v.candidate.tangent, {}};
      set.edges.assign(v.candidate.edges.begin(), v.candidate.edges.end());
      for (const FocusPart& part : v.component.parts) set.parts.push_back(part.sides);
      sets.push_back(std::move(set));
    }
    for (const TwoFingerVertex& v : two_finger_) {
      sets.push_back({GraspType::kTwoFinger,
                      {v.candidate.begin(), v.candidate.end()},
                      edges_.tangent(),
                      {v.part.stretching ? 1 : 0}});
    }
    for (const ParallelVertex& v : parallel_) {
      sets.push_back({GraspType::kParallel,
                      {v.edges.begin(), v.edges.end()},
                      edges_.tangent(),
                      v.component.centres});
    }
    return sets;
  }

  /// All edges but those between two-finger vertices; vertices are numbered as in MakeSets.
  std::vector<std::array<int, 2>> FindEdges() {
    first_two_finger_ = static_cast<int>(concurrent_.size());
    first_parallel_ = first_two_finger_ + static_cast<int>(two_finger_.size());
    ListByEdges();
    pairs_.resize(first_parallel_ + parallel_.size());
    JoinByPairs();
    JoinTwoFinger();
    if (spanning_ == planning::Spanning::kAdaptive) JoinSameTriples();
    return std::move(joins_);
  }

 private:
  void FindConcurrent(GraspTypeCounts& counts) {
    const auto candidates = FindConcurrentCandidates(edges_, spanning_, deadline_);
    counts.candidates = std::ssize(candidates);
    ConcurrentCellFinder finder(edges_);
    for (const ConcurrentCandidate& candidate : candidates) {
      deadline_.Check();
      std::vector<FocusComponent> cell = finder.Find(candidate);
      if (!cell.empty()) ++counts.combinations;
      for (FocusComponent& component : cell) {
        concurrent_.push_back({candidate, std::move(component)});
      }
    }
    counts.vertices = std::ssize(concurrent_);
  }

  void FindTwoFinger(GraspTypeCounts& counts) {
    const auto candidates = FindTwoFingerCandidates(edges_, deadline_);
    counts.candidates = std::ssize(candidates);
    for (const TwoFingerCandidate& candidate : candidates) {
      deadline_.Check();
      std::vector<TwoFingerPart> parts = FindTwoFingerSets(edges_, candidate);
      if (!parts.empty()) ++counts.combinations;
      for (TwoFingerPart& part : parts) two_finger_.push_back({candidate, std::move(part)});
    }
    counts.vertices = std::ssize(two_finger_);
  }

  void FindParallel(GraspTypeCounts& counts) {
    const auto candidates = FindParallelCandidates(edges_, deadline_);
    for (std::size_t i = 0; i < candidates.size();) {
      deadline_.Check();
      const Triple& triple = candidates[i].edges;
      std::vector<int> centres;
      for (; i < candidates.size() && candidates[i].edges == triple; ++i) {
        centres.push_back(candidates[i].centre);
      }
      ++counts.candidates;
      const auto components = FindParallelSets(edges_, triple, centres);
      if (!components.empty()) ++counts.combinations;
      for (const ParallelComponent& component : components) {
        parallel_.push_back({triple, component});
      }
    }
    counts.vertices = std::ssize(parallel_);
  }

  [[nodiscard]] bool IsConcurrent(int vertex) const { return vertex < first_two_finger_; }
  [[nodiscard]] bool IsParallel(int vertex) const { return vertex >= first_parallel_; }
  [[nodiscard]] const ParallelVertex& Parallel(int vertex) const {
    return parallel_[vertex - first_parallel_];
  }
  [[nodiscard]] const TwoFingerVertex& TwoFinger(int vertex) const {
    return two_finger_[vertex - first_two_finger_];
  }
  [[nodiscard]] std::span<const int> EdgesOf(int vertex) const {
    if (IsConcurrent(vertex)) return concurrent_[vertex].candidate.edges;
    if (IsParallel(vertex)) return Parallel(vertex).edges;
    return TwoFinger(vertex).candidate;
  }

  /// Three-finger vertices by pairs of edges, all vertices by edges, with their ranges there.
  void ListByEdges() {
    const int n = edges_.size();
    by_pair_.resize(static_cast<std::size_t>(n) * n);
    by_edge_.resize(n);
    const int count = first_parallel_ + static_cast<int>(parallel_.size());
    for (int v = 0; v < count; ++v) {
      deadline_.Check();
      const std::span<const int> on = EdgesOf(v);
      for (std::size_t k = 0; k < on.size(); ++k) {
        by_edge_[on[k]].push_back({v, RangeOf(v, static_cast<int>(k))});
        for (std::size_t l = k + 1; l < on.size() && on.size() == 3; ++l) {
          by_pair_[on[k] * n + on[l]].push_back(v);
        }
      }
    }
  }

  [[nodiscard]] FilteredRange RangeOf(int v, int k) const {
    if (IsConcurrent(v)) {
      return FocusContactRange(edges_, concurrent_[v].candidate, concurrent_[v].component, k);
    }
    if (IsParallel(v)) {
      return ParallelContactRange(edges_, Parallel(v).edges, Parallel(v).component, k);
    }
    return TwoFingerContactRange(TwoFinger(v).part, k);
  }

  const std::vector<FilteredRegion>& PairsOf(int v, int k, int l) {
    return pairs_[v].Get(k, l, [&](int i, int j) {
      return IsConcurrent(v)
                 ? FocusContactPairs(edges_, concurrent_[v].candidate, concurrent_[v].component, i,
                                     j)
                 : ParallelContactPairs(edges_, Parallel(v).edges, Parallel(v).component, i, j);
    });
  }

  void JoinByPairs() {
    for (const std::vector<int>& vertices : by_pair_) {
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        deadline_.Check();
        for (std::size_t j = i + 1; j < vertices.size(); ++j) {
          if (CanSwitch(vertices[i], vertices[j])) joins_.push_back({vertices[i], vertices[j]});
        }
      }
    }
  }

  /// Whether two three-finger vertices with two edges in common, or more, can switch over them.
  bool CanSwitch(int v, int w) {
    if (IsConcurrent(v) != IsConcurrent(w) && spanning_ == planning::Spanning::kUniform)
      return false;
    const CommonEdges common = FindCommonEdges(EdgesOf(v), EdgesOf(w));
    if (common.size() != 2) return false;
    if (IsConcurrent(v) && IsConcurrent(w)) {
      return FocusCellsOverlap(concurrent_[v].component, concurrent_[w].component,
                               {common.data(), common.size()});
    }
    const auto [first, second] = std::pair(common[0], common[1]);
    return Overlap(PairsOf(v, first.first, second.first), PairsOf(w, first.second, second.second));
  }

  void JoinTwoFinger() {
    for (int v = first_two_finger_; v < first_parallel_; ++v) {
      deadline_.Check();
      std::vector<int> joined;
      for (const int edge : EdgesOf(v)) {
        const std::vector<Listed>& listed = by_edge_[edge];
        const auto own = std::find_if(listed.begin(), listed.end(),
                                      [&](const Listed& l) { return l.vertex == v; });
        for (const Listed& other : listed) {
          if (EdgesOf(other.vertex).size() == 3 &&
              FilteredRange::Overlap(own->range, other.range)) {
            joined.push_back(other.vertex);
          }
        }
      }
      std::sort(joined.begin(), joined.end());
      joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
      for (const int other : joined) joins_.push_back({v, other});
    }
  }

  /// Concurrent and parallel grasps of the same three edges.
  void JoinSameTriples() {
    auto next = parallel_.begin();
    for (int v = 0; v < first_two_finger_; ++v) {
      deadline_.Check();
      const ConcurrentVertex& concurrent = concurrent_[v];
      const Triple& triple = concurrent.candidate.edges;
      while (next != parallel_.end() && next->edges < triple) ++next;
      for (auto it = next; it != parallel_.end() && it->edges == triple; ++it) {
        PairProjections projections;
        for (int k = 0; k < 3; ++k) {
          for (int l = k + 1; l < 3; ++l) projections[k][l] = PairsOf(v, k, l);
        }
        const bool shares = std::any_of(
            it->component.centres.begin(), it->component.centres.end(),
            [&](int centre) { return SharesGrasps(edges_, triple, centre, projections); });
        if (shares)
          joins_.push_back({v, first_parallel_ + static_cast<int>(it - parallel_.begin())});
      }
    }
  }

  struct Listed {
    int vertex;
    FilteredRange range;
  };

  planning::Spanning spanning_;
  EdgeTable edges_;
  const Deadline& deadline_;
  std::vector<ConcurrentVertex> concurrent_;
  std::vector<TwoFingerVertex> two_finger_;
  std::vector<ParallelVertex> parallel_;
  int first_two_finger_ = 0;
  int first_parallel_ = 0;
  std::vector<std::vector<int>> by_pair_;
  std::vector<std::vector<Listed>> by_edge_;
  std::vector<PairCache> pairs_;
  std::vector<std::array<int, 2>> joins_;
};

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

PolygonGraph::PolygonGraph(const object::Polygon& polygon, double half_angle,
                           planning::Spanning spanning, const Deadline& deadline) {
  if (!(half_angle > 0 && half_angle < std::numbers::pi / 2)) {
    throw std::invalid_argument("the friction half-angle is not in (0, pi/2)");
  }
  // Before the processor rounds upward.
  const double tangent = std::tan(half_angle);
  const IntervalScope scope;
  const auto begin = std::chrono::steady_clock::now();
  GraphBuilder builder(polygon, tangent, spanning, deadline);
  builder.FindVertices(counts_);
  sets_ = builder.MakeSets();
  vertex_seconds_ = SecondsSince(begin);
  const auto middle = std::chrono::steady_clock::now();
  neighbours_.resize(sets_.size());
  edges_ = builder.FindEdges();
  for (const auto& [a, b] : edges_) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  for (std::vector<int>& list : neighbours_) std::sort(list.begin(), list.end());
  for (int type = 0; type < kGraspTypes; ++type) {
    counts_[type].components = CountComponents(static_cast<GraspType>(type));
  }
  edge_seconds_ = SecondsSince(middle);
}

std::int64_t PolygonGraph::edge_count(GraspType a, GraspType b) const {
  if (a == GraspType::kTwoFinger && b == GraspType::kTwoFinger) {
    const std::int64_t n = counts(a).vertices;
    return n * (n - 1) / 2;
  }
  std::int64_t count = 0;
  for (std::size_t v = 0; v < sets_.size(); ++v) {
    if (sets_[v].type != a) continue;
    count += std::count_if(neighbours_[v].begin(), neighbours_[v].end(),
                           [&](int w) { return sets_[w].type == b; });
  }
  return a == b ? count / 2 : count;
}

search::Components PolygonGraph::components() const {
  std::vector<int> two_finger;
  for (int v = 0; v < vertex_count(); ++v) {
    if (sets_[v].type == GraspType::kTwoFinger) two_finger.push_back(v);
  }
  const int pairs = static_cast<int>(edges_.size());
  const bool any = !two_finger.empty();
  return search::FindComponents(vertex_count(), pairs + (any ? 1 : 0), [&](int group) {
    return group < pairs ? std::span<const int>(edges_[group]) : std::span<const int>(two_finger);
  });
}

std::int64_t PolygonGraph::CountComponents(GraspType type) const {
  if (type == GraspType::kTwoFinger) return counts(type).vertices > 0 ? 1 : 0;
  std::vector<std::array<int, 2>> inside;
  std::copy_if(edges_.begin(), edges_.end(), std::back_inserter(inside), [&](const auto& edge) {
    return sets_[edge[0]].type == type && sets_[edge[1]].type == type;
  });
  const search::Components all =
      search::FindComponents(vertex_count(), static_cast<int>(inside.size()),
                             [&](int group) { return std::span<const int>(inside[group]); });
  // Vertices of other types are components of their own.
  return all.count() - (vertex_count() - counts(type).vertices);
}

std::vector<int> PolygonGraph::SetsOn(const std::vector<int>& edges) const {
  std::vector<int> found;
  for (int v = 0; v < vertex_count(); ++v) {
    if (sets_[v].edges == edges) found.push_back(v);
  }
  return found;
}

void PolygonGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  neighbours = neighbours_[vertex];
  if (sets_[vertex].type != GraspType::kTwoFinger) return;
  for (int v = 0; v < vertex_count(); ++v) {
    if (v != vertex && sets_[v].type == GraspType::kTwoFinger) neighbours.push_back(v);
  }
  std::sort(neighbours.begin(), neighbours.end());
}

}  // namespace regrasp::polygon
