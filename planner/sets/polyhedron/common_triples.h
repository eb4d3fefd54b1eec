#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "planner/sets/polyhedron/normal_quadruples.h"

namespace regrasp::polyhedron {

/// A quadruple of faces, or what stands on it, by its number, as one of its triples sees it.
template <class Quadruple>
struct TripleOf {
  std::array<FaceIndex, 3> faces;
  Quadruple quadruple;

  auto operator<=>(const TripleOf&) const = default;
};

/// Adds the four triples of ascending faces.
template <class Quadruple>
void AddTriples(const FaceQuadruple& faces, Quadruple quadruple,
                std::vector<TripleOf<Quadruple>>& triples) {
  for (std::size_t left_out = 0; left_out < faces.size(); ++left_out) {
    TripleOf<Quadruple> triple = {{}, quadruple};
    for (std::size_t k = 0; k < 3; ++k) triple.faces[k] = faces[k < left_out ? k : k + 1];
    triples.push_back(triple);
  }
}

/// Sorts triples and calls visit(span<const TripleOf<Quadruple>>) for each run of those with the
/// same faces.
template <class Quadruple, class Visit>
void ForEachCommonTriple(std::vector<TripleOf<Quadruple>>& triples, const Visit& visit) {
  std::ranges::sort(triples);
  for (auto first = triples.begin(); first != triples.end();) {
    const auto end = std::find_if(first, triples.end(),
                                  [&](const auto& other) { return other.faces != first->faces; });
    visit(std::span<const TripleOf<Quadruple>>(first, end));
    first = end;
  }
}

}  // namespace regrasp::polyhedron
