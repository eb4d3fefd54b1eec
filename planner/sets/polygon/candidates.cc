#include "planner/sets/polygon/candidates.h"

#include <algorithm>
#include <ranges>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

EdgeTable::EdgeTable(const object::Polygon& polygon, double tangent) : tangent_(tangent) {
  int first = 0;
  for (const auto& ring : polygon.rings()) {
    const int n = static_cast<int>(ring.size());
    for (int k = 0; k < n; ++k) {
      const Eigen::Vector2d& a = ring[k];
      const Eigen::Vector2d& b = ring[(k + 1) % n];
      ends_.push_back({{a.x(), a.y()}, {b.x(), b.y()}});
      vertices_.push_back({first + k, first + (k + 1) % n});
      frames_.push_back(MakeEdgeFrame<Interval>(ends_.back(), tangent));
    }
    first += n;
  }
}

EdgeTable EdgeTable::Of(const std::vector<FaceIndex>& edges) const {
  EdgeTable table(tangent_);
  for (const FaceIndex edge : edges) {
    table.ends_.push_back(ends_[edge]);
    table.vertices_.push_back(vertices_[edge]);
    table.frames_.push_back(frames_[edge]);
  }
  return table;
}

namespace {

/// Return 0 for directions with angles in [0, π), otherwise 1.
template <class NT>
int HalfTurn(const Vector2<NT>& v) {
  const int y = Sign(v.y);
  return y > 0 || (y == 0 && Sign(v.x) > 0) ? 0 : 1;
}

template <class NT>
Vector2<NT> Normal(const EdgeFrame<NT>& frame) {
  return {-frame.along.y, frame.along.x};
}

/// Sort edges by the angles of their normals in [0, 2π), ties by index.
std::vector<FaceIndex> SortByAngle(const EdgeTable& edges) {
  std::vector<int> half(edges.size());
  std::vector<FaceIndex> order(edges.size());
  for (FaceIndex e{0}; e < edges.size(); ++e) {
    order[e] = e;
    half[e] =
        DecideFiltered([&](auto zero) { return HalfTurn(Normal(edges.frame<decltype(zero)>(e))); });
  }
  std::sort(order.begin(), order.end(), [&](FaceIndex a, FaceIndex b) {
    if (half[a] != half[b]) return half[a] < half[b];
    if (a == b) return false;
    const int turn = DecideFiltered([&](auto zero) {
      using NT = decltype(zero);
      return Sign(Cross(edges.frame<NT>(a).along, edges.frame<NT>(b).along));
    });
    return turn != 0 ? turn > 0 : a < b;
  });
  return order;
}

/// Return whether the counter-clockwise angle from the normal of `a` to that of `b` is a gap:
/// positive and below π, or for `uniform` below π − 2θ.
bool IsGap(const EdgeTable& edges, FaceIndex a, FaceIndex b, planning::Spanning spanning) {
  return DecideFiltered([&](auto zero) {
    using NT = decltype(zero);
    const EdgeFrame<NT> from = edges.frame<NT>(a);
    const EdgeFrame<NT> to = edges.frame<NT>(b);
    if (Sign(Cross(from.along, to.along)) <= 0) return false;
    return spanning == planning::Spanning::kAdaptive || Sign(Cross(from.right, to.left)) > 0;
  });
}

/// Compute tan((π − γ) / 2), with γ in (0, π) the angle from the normal of `a` to that of `b`.
template <class Number>
Interval HalfTangent(const Number& cross, const Number& dot, const Interval& lengths) {
  // One of the two forms of the tangent has no cancellation.
  const Interval c(CGAL::to_interval(cross));
  const Interval d(CGAL::to_interval(dot));
  return d.inf() > 0 ? (lengths + d) / c : c / (lengths - d);
}

/// Compute tan φ* of a gap, rounded down by at most 1e-13 · max(tan φ*, 1).
double SpanningTangent(const EdgeTable& edges, FaceIndex a, FaceIndex b) {
  /// Largest relative width of an interval; wider ones are recomputed from exact products.
  constexpr double kTightEnough = 1e-13;
  const auto bound = [&](auto zero) {
    using NT = decltype(zero);
    const Vector2<NT> u = edges.frame<NT>(a).along;
    const Vector2<NT> v = edges.frame<NT>(b).along;
    const NT squares = Dot(u, u) * Dot(v, v);
    return HalfTangent(Cross(u, v), Dot(u, v), CGAL::sqrt(Interval(CGAL::to_interval(squares))));
  };
  Interval tangent = bound(Interval());
  if (!(tangent.inf() > 0) || tangent.sup() - tangent.inf() > kTightEnough * tangent.sup()) {
    tangent = bound(Exact());
  }
  // At φ* two borders of the cones are opposite. After rounding down by this amount, intervals of
  // doubles can decide that they are not, and exact numbers are rarely necessary.
  constexpr double kTold = 0x1p-44;
  const double lowered = tangent.inf() - kTold * std::max(1.0, tangent.inf());
  return lowered > 0 ? lowered : tangent.inf();
}

/// Return whether two cones of angle θ have a common interior.
bool ConesMeet(const EdgeTable& edges, FaceIndex a, FaceIndex b, bool opposite) {
  return DecideFiltered([&](auto zero) {
    using NT = decltype(zero);
    const DirectionCone<NT> from = ConeOf(edges.frame<NT>(a));
    const DirectionCone<NT> to = ConeOf(edges.frame<NT>(b));
    return Intersect(from, opposite ? -to : to).has_value();
  });
}

/// Return whether the counter-clockwise angle from the normal of `a` to that of `b` is in (0, π),
/// or 0 with `b` after `a` among equal normals.
bool TurnsLeft(const EdgeTable& edges, FaceIndex a, FaceIndex b) {
  return DecideFiltered([&](auto zero) {
    using NT = decltype(zero);
    const Vector2<NT> u = edges.frame<NT>(a).along;
    const Vector2<NT> v = edges.frame<NT>(b).along;
    const int turn = Sign(Cross(u, v));
    return turn > 0 || (turn == 0 && a < b && Sign(Dot(u, v)) > 0);
  });
}

/// Return the first number in [begin, end) that satisfies a monotone predicate; `end` if there is
/// none.
template <class Predicate>
int FirstStep(int begin, int end, const Predicate& holds) {
  const auto steps = std::views::iota(begin, end);
  return begin +
         static_cast<int>(std::ranges::partition_point(steps, [&](int s) { return !holds(s); }) -
                          steps.begin());
}

/// For each edge, the edges whose normals are within 2θ of opposite. They are consecutive in the
/// order of angles.
class OpposedEdges {
 public:
  OpposedEdges(const EdgeTable& edges, const Deadline& deadline)
      : order_(SortByAngle(edges)), runs_(edges.size()) {
    const int n = edges.size();
    for (int rank = 0; rank < n; ++rank) {
      deadline.Check();
      const FaceIndex edge = order_[rank];
      const auto at = [&](int steps) { return order_[(rank + steps) % n]; };
      // Counter-clockwise steps to the first normal that is opposite or beyond.
      const int opposite =
          FirstStep(1, n, [&](int steps) { return !TurnsLeft(edges, edge, at(steps)); });
      // On either side of the opposite direction, the cones meet up to some normal and not beyond
      // it.
      const auto meet = [&](int steps) { return ConesMeet(edges, edge, at(steps), true); };
      const int first = FirstStep(1, opposite, meet);
      const int end = FirstStep(opposite, n, [&](int steps) { return !meet(steps); });
      runs_[edge] = {rank + first, end - first};
    }
  }

  [[nodiscard]] int count(FaceIndex edge) const { return runs_[edge].count; }
  [[nodiscard]] FaceIndex at(FaceIndex edge, int i) const {
    return order_[(runs_[edge].first + i) % order_.size()];
  }

 private:
  struct Run {
    int first = 0;  ///< rank in the order of angles, modulo the number of edges
    int count = 0;
  };

  std::vector<FaceIndex> order_;
  std::vector<Run> runs_;  ///< run of each edge
};

}  // namespace

std::vector<ConcurrentCandidate> FindConcurrentCandidates(const EdgeTable& edges,
                                                          planning::Spanning spanning,
                                                          const Deadline& deadline) {
  const std::vector<FaceIndex> order = SortByAngle(edges);
  const int n = edges.size();
  // Indexed by rank in `order`; a spanning triple has three gaps around the circle.
  std::vector<std::vector<char>> gap(n, std::vector<char>(n, 0));
  std::vector<std::vector<double>> limit(n, std::vector<double>(n, edges.tangent()));
  for (int r = 0; r < n; ++r) {
    deadline.Check();
    for (int s = 0; s < n; ++s) {
      if (r == s) continue;
      gap[r][s] = IsGap(edges, order[r], order[s], spanning);
      if (gap[r][s] && spanning == planning::Spanning::kAdaptive) {
        limit[r][s] = SpanningTangent(edges, order[r], order[s]);
      }
    }
  }
  std::vector<ConcurrentCandidate> candidates;
  for (int r = 0; r < n; ++r) {
    int third = r + 1;
    while (third < n && !gap[third][r]) ++third;
    for (int s = r + 1; s < n; ++s) {
      if (!gap[r][s]) continue;
      deadline.Check();
      for (int t = std::max(third, s + 1); t < n && gap[t][r]; ++t) {
        if (!gap[s][t]) continue;
        ConcurrentCandidate candidate{{order[r], order[s], order[t]}, edges.tangent()};
        for (const double tangent : {limit[r][s], limit[s][t], limit[t][r]}) {
          candidate.tangent = std::min(candidate.tangent, tangent);
        }
        std::sort(candidate.edges.begin(), candidate.edges.end());
        candidates.push_back(candidate);
      }
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const auto& a, const auto& b) { return a.edges < b.edges; });
  return candidates;
}

std::vector<TwoFingerCandidate> FindTwoFingerCandidates(const EdgeTable& edges,
                                                        const Deadline& deadline) {
  const OpposedEdges opposed(edges, deadline);
  std::vector<TwoFingerCandidate> candidates;
  std::vector<FaceIndex> partners;
  for (FaceIndex edge{0}; edge < edges.size(); ++edge) {
    deadline.Check();
    partners.clear();
    for (int i = 0; i < opposed.count(edge); ++i) {
      if (opposed.at(edge, i) > edge) partners.push_back(opposed.at(edge, i));
    }
    std::sort(partners.begin(), partners.end());
    for (const FaceIndex partner : partners) candidates.push_back({edge, partner});
  }
  return candidates;
}

CandidateSample DrawTwoFingerCandidates(const EdgeTable& edges, int count, RandomStream& random) {
  const OpposedEdges opposed(edges, {});
  std::vector<std::int64_t> up_to;  // cumulative number of pairs by edge, in both orders
  std::int64_t pairs = 0;
  for (FaceIndex edge{0}; edge < edges.size(); ++edge)
    up_to.push_back(pairs += opposed.count(edge));
  CandidateSample sample{pairs / 2, {}};
  for (int i = 0; i < count && pairs > 0; ++i) {
    const auto drawn = static_cast<std::int64_t>(random.Index(static_cast<std::uint64_t>(pairs)));
    const auto above = std::ranges::upper_bound(up_to, drawn);
    const FaceIndex edge(static_cast<int>(above - up_to.begin()));
    const FaceIndex other = opposed.at(edge, static_cast<int>(*above - drawn - 1));
    sample.drawn.push_back({std::min(edge, other), std::max(edge, other)});
  }
  return sample;
}

std::vector<ParallelCandidate> FindParallelCandidates(const EdgeTable& edges,
                                                      const Deadline& deadline) {
  std::vector<std::pair<EdgeTriple, int>> centred;  // triples with the position of one centre
  for (FaceIndex centre{0}; centre < edges.size(); ++centre) {
    std::vector<FaceIndex> opposite;
    for (FaceIndex e{0}; e < edges.size(); ++e) {
      if (e != centre && ConesMeet(edges, centre, e, true)) opposite.push_back(e);
    }
    for (std::size_t i = 0; i < opposite.size(); ++i) {
      deadline.Check();
      for (std::size_t j = i + 1; j < opposite.size(); ++j) {
        const bool meet = DecideFiltered([&](auto zero) {
          using NT = decltype(zero);
          return CommonCone(edges.frame<NT>(centre), edges.frame<NT>(opposite[i]),
                            edges.frame<NT>(opposite[j]))
              .has_value();
        });
        if (!meet) continue;
        EdgeTriple triple = {centre, opposite[i], opposite[j]};
        std::ranges::sort(triple);
        centred.emplace_back(triple, std::ranges::find(triple, centre) - triple.begin());
      }
    }
  }
  std::ranges::sort(centred);
  std::vector<ParallelCandidate> candidates;
  for (const auto& [triple, centre] : centred) {
    if (candidates.empty() || candidates.back().edges != triple) candidates.push_back({triple, {}});
    candidates.back().centres.push_back(centre);
  }
  return candidates;
}

}  // namespace regrasp::polygon
