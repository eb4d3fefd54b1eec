#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace regrasp::polyhedron {

/// A quadruple of faces, by its number, as one of its triples sees it.
struct TripleOf {
  std::array<int, 3> faces;
  int quadruple;

  auto operator<=>(const TripleOf&) const = default;
};

/// Adds the four triples of ascending faces.
inline void AddTriples(const std::array<int, 4>& faces, int quadruple,
                       std::vector<TripleOf>& triples) {
  for (std::size_t left_out = 0; left_out < faces.size(); ++left_out) {
    TripleOf triple = {{}, quadruple};
    for (std::size_t k = 0; k < 3; ++k) triple.faces[k] = faces[k < left_out ? k : k + 1];
    triples.push_back(triple);
  }
}

/// Sorts triples and calls visit(span<const TripleOf>) for each run of those with the same faces.
template <class Visit>
void ForEachCommonTriple(std::vector<TripleOf>& triples, const Visit& visit) {
  std::ranges::sort(triples);
  for (auto first = triples.begin(); first != triples.end();) {
    const auto end = std::find_if(
        first, triples.end(), [&](const TripleOf& other) { return other.faces != first->faces; });
    visit(std::span<const TripleOf>(first, end));
    first = end;
  }
}

}  // namespace regrasp::polyhedron
