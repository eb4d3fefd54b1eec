#include "planner/sets/polyhedron/polyhedron_graph.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace regrasp::polyhedron {

namespace {

double SecondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double CheckedTangent(double half_angle) {
  if (half_angle > 0 && half_angle < std::numbers::pi / 2) return std::tan(half_angle);
  throw std::invalid_argument("the friction half-angle is not in (0, pi/2)");
}

/// A cell as one of its triples of faces sees it.
struct OfTriple {
  std::array<int, 3> faces;
  int cell;

  auto operator<=>(const OfTriple&) const = default;
};

}  // namespace

PolyhedronGraph::PolyhedronGraph(const object::Polyhedron& solid, double half_angle,
                                 planning::Spanning spanning, const Deadline& deadline)
    : finder_(solid, CheckedTangent(half_angle)) {
  const auto begin = std::chrono::steady_clock::now();
  const auto candidates =
      FindQuadrupleCandidates(solid, CheckedTangent(half_angle), spanning, deadline);
  candidates_ = std::ssize(candidates);
  for (const QuadrupleCandidate& candidate : candidates) {
    deadline.Check();
    std::vector<FocusCell> found = finder_.Find(candidate);
    if (!found.empty()) ++combinations_;
    std::ranges::move(found, std::back_inserter(cells_));
  }
  vertex_seconds_ = SecondsSince(begin);
  const auto middle = std::chrono::steady_clock::now();
  FindLinks(deadline);
  edge_seconds_ = SecondsSince(middle);
}

void PolyhedronGraph::FindLinks(const Deadline& deadline) {
  std::vector<OfTriple> of_triples;
  of_triples.reserve(4 * cells_.size());
  for (int cell = 0; cell < vertex_count(); ++cell) {
    const std::array<int, 4>& f = cells_[cell].faces;
    for (std::size_t left_out = 0; left_out < f.size(); ++left_out) {
      OfTriple of_triple;
      for (std::size_t k = 0; k < 3; ++k) of_triple.faces[k] = f[k < left_out ? k : k + 1];
      of_triple.cell = cell;
      of_triples.push_back(of_triple);
    }
  }
  std::sort(of_triples.begin(), of_triples.end());
  for (auto first = of_triples.begin(); first != of_triples.end();) {
    const auto end = std::find_if(first, of_triples.end(),
                                  [&](const OfTriple& t) { return t.faces != first->faces; });
    for (auto a = first; a != end; ++a) {
      deadline.Check();
      for (auto b = a + 1; b != end; ++b) {
        // Two components of one cell share all four faces.
        if (cells_[a->cell].faces == cells_[b->cell].faces) continue;
        if (finder_.Overlap(cells_[a->cell], cells_[b->cell])) links_.push_back({a->cell, b->cell});
      }
    }
    first = end;
  }
  std::sort(links_.begin(), links_.end());
  neighbours_.resize(cells_.size());
  for (const auto& [a, b] : links_) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  for (std::vector<int>& list : neighbours_) std::sort(list.begin(), list.end());
}

search::Components PolyhedronGraph::components() const {
  return search::FindComponents(vertex_count(), static_cast<int>(links_.size()),
                                [&](int i) { return std::span<const int>(links_[i]); });
}

void PolyhedronGraph::GetNeighbours(int vertex, std::vector<int>& neighbours) const {
  neighbours = neighbours_[vertex];
}

}  // namespace regrasp::polyhedron
