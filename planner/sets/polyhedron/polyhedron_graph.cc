#include "planner/sets/polyhedron/polyhedron_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_set>

#include "planner/base/random.h"
#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

PolyhedronGraph::PolyhedronGraph(const object::Polyhedron& solid, double friction_angle,
                                 planning::Spanning spanning, const Deadline& deadline,
                                 const Tell& tell)
    : finder_(solid, CheckedTangent(friction_angle)) {
  BeginVertices();
  const auto candidates =
      FindQuadrupleCandidates(solid, CheckedTangent(friction_angle), spanning, deadline);
  candidates_ = std::ssize(candidates);
  CountedProgress progress(tell, "testing quadruples of faces", candidates_);
  for (const QuadrupleCandidate& candidate : candidates) {
    deadline.Check();
    progress.Add();
    std::vector<FocusCell> found = finder_.Find(candidate);
    if (!found.empty()) ++combinations_;
    std::ranges::move(found, std::back_inserter(cells_));
  }
  EndVertices(static_cast<int>(cells_.size()));
  EndEdges(FindSwitches(deadline, tell));
}

std::vector<sets::SetPair> PolyhedronGraph::FindSwitches(const Deadline& deadline,
                                                         const Tell& tell) {
  std::vector<TripleOf<sets::SetIndex>> triples;
  triples.reserve(4 * cells_.size());
  for (sets::SetIndex cell{0}; cell < vertex_count(); ++cell) {
    AddTriples(cells_[cell].faces, cell, triples);
  }
  std::vector<sets::SetPair> switches;
  CountedProgress progress(tell, "joining focus cells on triples of faces", std::ssize(triples));
  ForEachCommonTriple(triples, [&](const auto& common) {
    for (auto a = common.begin(); a != common.end(); ++a) {
      deadline.Check();
      progress.Add();
      for (auto b = a + 1; b != common.end(); ++b) {
        const FocusCell& first = cells_[a->quadruple];
        const FocusCell& second = cells_[b->quadruple];
        // Two components of one cell have four common faces.
        if (first.faces == second.faces || !finder_.Overlap(first, second)) continue;
        switches.push_back({a->quadruple, b->quadruple});
      }
    }
  });
  std::ranges::sort(switches);
  return switches;
}

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace {

/// First step by which a side of the region moves, divided by the diameter. Steps double.
constexpr double kRegionAccuracy = 1e-3;

/// Enlarges a box until it contains all focus points of a piece.
class RegionGrower {
 public:
  RegionGrower(const object::Polyhedron& solid, PolyhedronGraph& graph)
      : finder_(graph.finder()), step_(kRegionAccuracy * solid.diameter()) {}

  void Include(const FocusCell& cell, const FocusPiece& piece, AlignedBox3d& box) {
    box.extend(piece.point);
    volumes_ = finder_.VolumesOf(piece, cell.tangent);
    for (int axis = 0; axis < 3; ++axis) {
      Grow(Vector3d::Unit(axis), box.max()[axis]);
      double low = -box.min()[axis];
      Grow(-Vector3d::Unit(axis), low);
      box.min()[axis] = -low;
    }
  }

 private:
  /// Increase `limit` until no point of the piece has a larger x · direction.
  void Grow(const Vector3d& direction, double& limit) {
    double step = step_;
    while (ReachesBeyond(direction, limit)) {
      limit += step;
      step *= 2;
    }
  }

  [[nodiscard]] bool ReachesBeyond(const Vector3d& direction, double limit) {
    const Cut beyond = {-direction, limit};
    return finder_.HasPoint([&](const Vector3d& x) {
      const Cut of_volumes = LargestCutAt(volumes_, x);
      return of_volumes.At(x) <= beyond.At(x) ? beyond : of_volumes;
    });
  }

  FocusCellFinder& finder_;
  double step_;
  std::vector<UnionVolume> volumes_;
};

/// Index of a QuadrupleCandidate, whether or not points see it.
using CandidateIndex = Index<struct CandidateTag>;

/// Collects the quadruples that points see.
class Sampler {
 public:
  Sampler(const object::Polyhedron& solid, double friction_angle, planning::Spanning spanning,
          const Deadline& deadline)
      : finder_(solid, std::tan(friction_angle)), tangent_(std::tan(friction_angle)) {
    candidates_ = FindQuadrupleCandidates(solid, tangent_, spanning, deadline);
    found_.assign(candidates_.size(), 0);
    seen_.assign(solid.face_count(), 0);
    const HalfIndex end(2 * static_cast<int>(finder_.parts().parts.size()));
    for (HalfIndex half{0}; half < end; ++half) {
      volumes_.push_back(finder_.VolumeOf(half, tangent_));
    }
  }

  void Include(const Vector3d& x) {
    std::ranges::fill(seen_, 0);
    for (std::size_t half = 0; half < volumes_.size(); ++half) {
      if (volumes_[half].At(x) < 0) seen_[finder_.parts().parts[half / 2].face] = 1;
    }
    triples_.clear();
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const QuadrupleCandidate& candidate = candidates_[c];
      const bool sees =
          std::ranges::all_of(candidate.faces, [&](FaceIndex f) { return seen_[f] != 0; });
      if (!sees || !SeesNarrowly(candidate, x)) continue;
      found_[c] = 1;
      AddTriples(candidate.faces, CandidateIndex(static_cast<int>(c)), triples_);
    }
    ForEachCommonTriple(triples_, [&](const auto& common) {
      for (auto a = common.begin(); a != common.end(); ++a) {
        for (auto b = a + 1; b != common.end(); ++b) {
          links_.insert(static_cast<std::uint64_t>(a->quadruple) << 32 |
                        static_cast<std::uint64_t>(b->quadruple));
        }
      }
    });
  }

  [[nodiscard]] SampledGraph Result() const {
    SampledGraph graph;
    std::vector<QuadrupleIndex> number(candidates_.size());
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      if (found_[c] == 0) continue;
      number[c] = QuadrupleIndex(static_cast<int>(graph.quadruples.size()));
      graph.quadruples.push_back(candidates_[c].faces);
    }
    for (const std::uint64_t link : links_) {
      graph.links.push_back({number[link >> 32], number[link & 0xffffffff]});
    }
    std::ranges::sort(graph.links);
    graph.components =
        search::ComponentsOfEdges(static_cast<int>(graph.quadruples.size()), graph.links).count();
    return graph;
  }

 private:
  /// Return whether a point sees the faces in the candidate's own cones, which can be narrower than
  /// the friction cones.
  [[nodiscard]] bool SeesNarrowly(const QuadrupleCandidate& candidate, const Vector3d& x) const {
    if (candidate.tangent == tangent_) return true;
    return std::ranges::all_of(candidate.faces, [&](FaceIndex face) {
      const auto& first = finder_.parts().first;
      for (HalfIndex half(2 * first[face]); half < 2 * first[face + 1]; ++half) {
        if (finder_.VolumeOf(half, candidate.tangent).At(x) < 0) return true;
      }
      return false;
    });
  }

  FocusCellFinder finder_;
  double tangent_;
  std::vector<QuadrupleCandidate> candidates_;
  std::vector<char> found_;
  std::vector<UnionVolume> volumes_;
  std::vector<char> seen_;                         ///< whether the current point sees each face
  std::vector<TripleOf<CandidateIndex>> triples_;  ///< triples that the current point sees
  std::unordered_set<std::uint64_t> links_;  ///< two candidates; the lower one is in the upper half
};

}  // namespace

AlignedBox3d FindSamplingRegion(const object::Polyhedron& solid, PolyhedronGraph& graph,
                                const Deadline& deadline) {
  AlignedBox3d box;
  RegionGrower grower(solid, graph);
  for (const FocusCell& cell : graph.cells()) {
    deadline.Check();
    for (const FocusPiece& piece : cell.pieces) grower.Include(cell, piece, box);
  }
  return box;
}

SampledGraph SamplePolyhedron(const object::Polyhedron& solid, double friction_angle,
                              planning::Spanning spanning, const AlignedBox3d& region, int points,
                              std::uint64_t seed, const Deadline& deadline, const Tell& tell) {
  Sampler sampler(solid, friction_angle, spanning, deadline);
  RandomStream random(seed, RandomUse::kFocusPoints);
  CountedProgress progress(tell, "sampling focus points", points);
  for (int i = 0; i < points && !region.isEmpty(); ++i) {
    deadline.Check();
    progress.Add();
    Vector3d share;
    for (int axis = 0; axis < 3; ++axis) share[axis] = random.Uniform();
    sampler.Include(region.min() + share.cwiseProduct(region.sizes()));
  }
  return sampler.Result();
}

planning::SamplingShare CompareSampling(const SampledGraph& sampled, const PolyhedronGraph& graph) {
  std::set<FaceQuadruple> quadruples;
  for (const FocusCell& cell : graph.cells()) quadruples.insert(cell.faces);
  std::set<std::array<FaceQuadruple, 2>> links;
  for (const auto& [a, b] : graph.switches()) {
    links.insert({graph.cells()[a].faces, graph.cells()[b].faces});
  }
  planning::SamplingShare share;
  share.quadruples = std::ssize(quadruples);
  share.links = std::ssize(links);
  share.found_quadruples = std::ranges::count_if(
      sampled.quadruples, [&](const FaceQuadruple& q) { return quadruples.contains(q); });
  share.found_links = std::ranges::count_if(sampled.links, [&](const auto& link) {
    return links.contains({sampled.quadruples[link[0]], sampled.quadruples[link[1]]});
  });
  return share;
}

}  // namespace regrasp::polyhedron
