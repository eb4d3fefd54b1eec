#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/plan_request.h"

namespace regrasp::polyhedron {

/// Four faces, ascending.
using FaceQuadruple = std::array<FaceIndex, 4>;

/// Four faces whose normals let them hold concurrent grasps.
struct QuadrupleCandidate {
  FaceQuadruple faces;
  double tangent = 0;  ///< tan φ
};

/// The quadruples whose inward normals θ-positively span space (uniform), or positively span it
/// (adaptive; φ = min(θ, φ*)). φ* = arcsin of the distance from the origin to the border of the
/// hull of the four normals: to the nearest of the four planes through three of them (Phoka 2010,
/// section 5.2, in closed form). In lexicographic order.
///
/// For each pair of normals one bit per normal says on which side of the plane through the pair it
/// is; the fourth normals of a triple are where three rows of bits agree (the trihedron of its
/// opposites), so the time goes with the triples and with what is found.
///
/// @param normals  of the faces 0, 1, …; unit. Normals that are coplanar up to rounding do not
/// span.
/// @throws TimeUp  the deadline came.
[[nodiscard]] std::vector<QuadrupleCandidate> FindQuadrupleCandidates(
    const std::vector<Eigen::Vector3d>& normals, double tangent, planning::Spanning spanning,
    const Deadline& deadline = {});

/// Those of the faces of a solid that a finger can come to: the walls of sealed cavities are not.
[[nodiscard]] std::vector<QuadrupleCandidate> FindQuadrupleCandidates(
    const object::Polyhedron& solid, double tangent, planning::Spanning spanning,
    const Deadline& deadline = {});

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
