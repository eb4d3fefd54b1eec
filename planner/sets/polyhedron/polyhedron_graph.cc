#include "planner/sets/polyhedron/polyhedron_graph.h"

#include <algorithm>
#include <iterator>

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

}  // namespace regrasp::polyhedron
