#include "planner/sets/polygon/polygon_graph.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace regrasp::polygon {

using sets::SetIndex;
using sets::SetPair;

namespace {

bool Overlap(const std::vector<FilteredRegion>& a, const std::vector<FilteredRegion>& b) {
  return std::any_of(a.begin(), a.end(), [&](const FilteredRegion& region) {
    return std::any_of(b.begin(), b.end(), [&](const FilteredRegion& other) {
      return FilteredRegion::Overlap(region, other);
    });
  });
}

/// Contact pairs of a vertex, computed on first use.
class PairCache {
 public:
  template <class Make>
  const std::vector<FilteredRegion>& Get(int k, int l, const Make& make) {
    std::optional<std::vector<FilteredRegion>>& pairs = pairs_[k + l - 1];
    if (!pairs) pairs = make(k, l);
    return *pairs;
  }

 private:
  std::array<std::optional<std::vector<FilteredRegion>>, 3> pairs_;  ///< pairs (0,1), (0,2), (1,2)
};

std::vector<GraspSet> MakeSets(const PolygonVertices& vertices, double tangent) {
  std::vector<GraspSet> sets;
  for (const auto& v : vertices.concurrent) {
    GraspSet set{GraspType::kConcurrent, {}, v.candidate.tangent, {}};
    set.edges.assign(v.candidate.edges.begin(), v.candidate.edges.end());
    for (const FocusPart& part : v.component.parts) set.parts.push_back(part.sides);
    sets.push_back(std::move(set));
  }
  for (const auto& v : vertices.two_finger) {
    sets.push_back({GraspType::kTwoFinger,
                    {v.candidate.begin(), v.candidate.end()},
                    tangent,
                    {v.component.stretching ? 1 : 0}});
  }
  for (const auto& v : vertices.parallel) {
    sets.push_back({GraspType::kParallel,
                    {v.candidate.edges.begin(), v.candidate.edges.end()},
                    tangent,
                    v.component.centres});
  }
  return sets;
}

/// Finds the switches between vertices, numbered as in MakeSets. Use it in an IntervalScope.
class SwitchFinder {
 public:
  /// All arguments must outlive this object.
  SwitchFinder(const EdgeTable& edges, const PolygonVertices& vertices, planning::Spanning spanning,
               const Deadline& deadline, const Tell& tell)
      : spanning_(spanning),
        edges_(edges),
        deadline_(deadline),
        tell_(tell),
        vertices_(vertices),
        first_two_finger_(static_cast<int>(vertices.concurrent.size())),
        first_parallel_(first_two_finger_ + static_cast<int>(vertices.two_finger.size())),
        pairs_(first_parallel_ + vertices.parallel.size()) {}

  /// Find all switches, except those between two-finger vertices.
  std::vector<SetPair> Find() {
    ListByEdges();
    JoinByPairs();
    JoinTwoFinger();
    if (spanning_ == planning::Spanning::kAdaptive) JoinSameTriples();
    return std::move(joins_);
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(pairs_.size()); }
  [[nodiscard]] bool IsConcurrent(SetIndex vertex) const { return vertex < first_two_finger_; }
  [[nodiscard]] bool IsParallel(SetIndex vertex) const { return vertex >= first_parallel_; }
  [[nodiscard]] const auto& Concurrent(SetIndex vertex) const {
    return vertices_.concurrent[vertex];
  }
  [[nodiscard]] const auto& TwoFinger(SetIndex vertex) const {
    return vertices_.two_finger[vertex - first_two_finger_];
  }
  [[nodiscard]] const auto& Parallel(SetIndex vertex) const {
    return vertices_.parallel[vertex - first_parallel_];
  }
  [[nodiscard]] std::span<const FaceIndex> EdgesOf(SetIndex vertex) const {
    if (IsConcurrent(vertex)) return Concurrent(vertex).candidate.edges;
    if (IsParallel(vertex)) return Parallel(vertex).candidate.edges;
    return TwoFinger(vertex).candidate;
  }

  /// Index three-finger vertices by pairs of edges, and all vertices by edges with their ranges.
  void ListByEdges() {
    const int n = edges_.size();
    by_pair_.resize(static_cast<std::size_t>(n) * n);
    by_edge_.resize(n);
    CountedProgress progress(tell_, "projecting sets of grasps on edges", count());
    for (SetIndex v{0}; v < count(); ++v) {
      deadline_.Check();
      progress.Add();
      const std::span<const FaceIndex> on = EdgesOf(v);
      for (std::size_t k = 0; k < on.size(); ++k) {
        by_edge_[on[k]].push_back({v, RangeOf(v, static_cast<int>(k))});
        for (std::size_t l = k + 1; l < on.size() && on.size() == 3; ++l) {
          by_pair_[on[k] * n + on[l]].push_back(v);
        }
      }
    }
  }

  [[nodiscard]] FilteredRange RangeOf(SetIndex v, int k) const {
    if (IsConcurrent(v)) {
      return FocusContactRange(edges_, Concurrent(v).candidate, Concurrent(v).component, k);
    }
    if (IsParallel(v)) {
      return ParallelContactRange(edges_, Parallel(v).candidate.edges, Parallel(v).component, k);
    }
    return TwoFingerContactRange(TwoFinger(v).component, k);
  }

  const std::vector<FilteredRegion>& PairsOf(SetIndex v, int k, int l) {
    return pairs_[v].Get(k, l, [&](int i, int j) {
      return IsConcurrent(v)
                 ? FocusContactPairs(edges_, Concurrent(v).candidate, Concurrent(v).component, i, j)
                 : ParallelContactPairs(edges_, Parallel(v).candidate.edges, Parallel(v).component,
                                        i, j);
    });
  }

  void JoinByPairs() {
    CountedProgress progress(tell_, "joining sets of grasps on pairs of edges",
                             std::ssize(by_pair_));
    for (const std::vector<SetIndex>& vertices : by_pair_) {
      progress.Add();
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        deadline_.Check();
        for (std::size_t j = i + 1; j < vertices.size(); ++j) {
          if (CanSwitch(vertices[i], vertices[j])) joins_.push_back({vertices[i], vertices[j]});
        }
      }
    }
  }

  /// Return whether two three-finger vertices can switch over their two common edges.
  bool CanSwitch(SetIndex v, SetIndex w) {
    if (IsConcurrent(v) != IsConcurrent(w) && spanning_ == planning::Spanning::kUniform)
      return false;
    const CommonEdges common = FindCommonEdges(EdgesOf(v), EdgesOf(w));
    if (common.size() != 2) return false;
    if (IsConcurrent(v) && IsConcurrent(w)) {
      return FocusCellsOverlap(Concurrent(v).component, Concurrent(w).component,
                               {common.data(), common.size()});
    }
    const auto [first, second] = std::pair(common[0], common[1]);
    return Overlap(PairsOf(v, first.first, second.first), PairsOf(w, first.second, second.second));
  }

  void JoinTwoFinger() {
    CountedProgress progress(tell_, "joining sets of 2-finger grasps",
                             first_parallel_ - first_two_finger_);
    for (SetIndex v = first_two_finger_; v < first_parallel_; ++v) {
      deadline_.Check();
      progress.Add();
      std::vector<SetIndex> joined;
      for (const FaceIndex edge : EdgesOf(v)) {
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
      for (const SetIndex other : joined) joins_.push_back({v, other});
    }
  }

  /// Connect concurrent and parallel sets on the same three edges that share grasps.
  void JoinSameTriples() {
    SetIndex first = first_parallel_;
    CountedProgress progress(tell_, "joining sets of grasps on the same edges", first_two_finger_);
    for (SetIndex v{0}; v < first_two_finger_; ++v) {
      deadline_.Check();
      progress.Add();
      const EdgeTriple& triple = Concurrent(v).candidate.edges;
      while (first < count() && Parallel(first).candidate.edges < triple) ++first;
      for (SetIndex w = first; w < count() && Parallel(w).candidate.edges == triple; ++w) {
        PairProjections projections;
        for (int k = 0; k < 3; ++k) {
          for (int l = k + 1; l < 3; ++l) projections[k][l] = PairsOf(v, k, l);
        }
        const bool shares = std::ranges::any_of(Parallel(w).component.centres, [&](int centre) {
          return SharesGrasps(edges_, triple, centre, projections);
        });
        if (shares) joins_.push_back({v, w});
      }
    }
  }

  struct Listed {
    SetIndex vertex;
    FilteredRange range;
  };

  planning::Spanning spanning_;
  const EdgeTable& edges_;
  const Deadline& deadline_;
  const Tell& tell_;
  const PolygonVertices& vertices_;
  SetIndex first_two_finger_;
  SetIndex first_parallel_;
  std::vector<std::vector<SetIndex>> by_pair_;
  std::vector<std::vector<Listed>> by_edge_;
  std::vector<PairCache> pairs_;
  std::vector<SetPair> joins_;
};

}  // namespace

PolygonGraph::PolygonGraph(const object::Polygon& polygon, double friction_angle,
                           planning::Spanning spanning, const Deadline& deadline,
                           const Tell& tell) {
  // Computed before the processor rounds upward.
  const double tangent = CheckedTangent(friction_angle);
  const IntervalScope scope;
  BeginVertices();
  const EdgeTable edges(polygon, tangent);
  const PolygonVertices vertices = FindVertices(edges, spanning, deadline, tell);
  counts_ = vertices.counts;
  sets_ = MakeSets(vertices, tangent);
  EndVertices(static_cast<int>(sets_.size()));
  std::vector<SetIndex> two_finger;
  for (SetIndex v{0}; v < vertex_count(); ++v) {
    if (sets_[v].type == GraspType::kTwoFinger) two_finger.push_back(v);
  }
  EndEdges(SwitchFinder(edges, vertices, spanning, deadline, tell).Find(), two_finger);
  for (int type = 0; type < kGraspTypes; ++type) {
    counts_[type].components = CountComponents(static_cast<GraspType>(type));
  }
}

std::int64_t PolygonGraph::edge_count(GraspType a, GraspType b) const {
  if (a == GraspType::kTwoFinger && b == GraspType::kTwoFinger) {
    const std::int64_t n = counts(a).vertices;
    return n * (n - 1) / 2;
  }
  return std::ranges::count_if(switches(), [&](const auto& pair) {
    const GraspType first = sets_[pair[0]].type;
    const GraspType second = sets_[pair[1]].type;
    return (first == a && second == b) || (first == b && second == a);
  });
}

std::int64_t PolygonGraph::CountComponents(GraspType type) const {
  if (type == GraspType::kTwoFinger) return counts(type).vertices > 0 ? 1 : 0;
  std::vector<SetPair> inside;
  std::ranges::copy_if(switches(), std::back_inserter(inside), [&](const auto& pair) {
    return sets_[pair[0]].type == type && sets_[pair[1]].type == type;
  });
  const search::Components all = search::ComponentsOfEdges(vertex_count(), inside);
  // Each vertex of another type is a component here.
  return all.count() - (vertex_count() - counts(type).vertices);
}

std::vector<SetIndex> PolygonGraph::SetsOn(const std::vector<FaceIndex>& edges) const {
  std::vector<SetIndex> found;
  for (SetIndex v{0}; v < vertex_count(); ++v) {
    if (sets_[v].edges == edges) found.push_back(v);
  }
  return found;
}

std::vector<TwoFingerPart> FindTwoFingerSets(const EdgeTable& edges,
                                             const TwoFingerCandidate& candidate) {
  std::vector<TwoFingerPart> parts;
  for (const bool stretching : {false, true}) {
    auto region = FilteredRegion::Make([&edges, candidate, stretching](auto zero) {
      using NT = decltype(zero);
      return MakeTwoFingerRegion(edges.frame<NT>(candidate[0]), edges.frame<NT>(candidate[1]),
                                 stretching);
    });
    if (region) parts.push_back({stretching, std::move(*region)});
  }
  return parts;
}

FilteredRange TwoFingerContactRange(const TwoFingerPart& part, int k) {
  return FilteredRange(
      [&part, k](auto zero) { return TwoFingerRange(part.region.as<decltype(zero)>(), k); });
}

namespace {

/// Find the sets of all candidates and count them.
/// @param find  function that returns the sets on a candidate's edges.
template <class Candidate, class Component, class Find>
GraspTypeCounts FindOnCandidates(const std::vector<Candidate>& candidates, const Deadline& deadline,
                                 CountedProgress& progress, const Find& find,
                                 std::vector<PolygonVertex<Candidate, Component>>& vertices) {
  GraspTypeCounts counts;
  counts.candidates = std::ssize(candidates);
  for (const Candidate& candidate : candidates) {
    deadline.Check();
    progress.Add();
    std::vector<Component> found = find(candidate);
    if (!found.empty()) ++counts.combinations;
    for (Component& component : found) vertices.push_back({candidate, std::move(component)});
  }
  counts.vertices = std::ssize(vertices);
  return counts;
}

}  // namespace

PolygonVertices FindVertices(const EdgeTable& edges, planning::Spanning spanning,
                             const Deadline& deadline, const Tell& tell) {
  PolygonVertices vertices;
  ConcurrentCellFinder finder(edges);
  const auto counts = [&](GraspType type) -> GraspTypeCounts& {
    return vertices.counts[static_cast<int>(type)];
  };
  const auto find_all = [&](GraspType type, const char* what, const auto& candidates,
                            const auto& find, auto& found) {
    CountedProgress progress(tell, "testing " + std::string(what), std::ssize(candidates));
    counts(type) = FindOnCandidates(candidates, deadline, progress, find, found);
  };
  find_all(
      GraspType::kConcurrent, "triples of edges for concurrent grasps",
      FindConcurrentCandidates(edges, spanning, deadline),
      [&](const ConcurrentCandidate& c) { return finder.Find(c); }, vertices.concurrent);
  find_all(
      GraspType::kTwoFinger, "pairs of edges", FindTwoFingerCandidates(edges, deadline),
      [&](const TwoFingerCandidate& c) { return FindTwoFingerSets(edges, c); },
      vertices.two_finger);
  find_all(
      GraspType::kParallel, "triples of edges for parallel grasps",
      FindParallelCandidates(edges, deadline),
      [&](const ParallelCandidate& c) { return FindParallelSets(edges, c); }, vertices.parallel);
  return vertices;
}

}  // namespace regrasp::polygon
