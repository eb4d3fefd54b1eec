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

/// Four faces in ascending order.
using FaceQuadruple = std::array<FaceIndex, 4>;

/// Four faces whose normals permit concurrent grasps.
struct QuadrupleCandidate {
  FaceQuadruple faces;
  double tangent = 0;  ///< tan φ of its cones
};

/// Find the quadruples of faces whose inward normals span space, in lexicographic order.
///
/// With `uniform`, the normals must θ-positively span it. With `adaptive`, they must positively
/// span it, and φ = min(θ, φ*). φ* is the arcsine of the distance from the origin to the nearest of
/// the four planes through three of the normals (Phoka 2010, section 5.2, in closed form).
///
/// For each pair of normals, one bit per normal states on which side of the plane through the pair
/// it is. The fourth normals of a triple are in the trihedron of its opposites: the positions at
/// which three rows of bits agree. The time is therefore proportional to the number of triples and
/// results.
///
/// @param normals  unit normals of the faces 0, 1, … Normals that are coplanar up to rounding do
///     not span.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<QuadrupleCandidate> FindQuadrupleCandidates(
    const std::vector<Eigen::Vector3d>& normals, double tangent, planning::Spanning spanning,
    const Deadline& deadline = {});

/// Find the quadruples of a solid's faces on which planners place fingers (Object::TakesFingers).
[[nodiscard]] std::vector<QuadrupleCandidate> FindQuadrupleCandidates(
    const object::Polyhedron& solid, double tangent, planning::Spanning spanning,
    const Deadline& deadline = {});

/// Three faces of a quadruple, with the number of the quadruple or of an element related to it.
template <class Quadruple>
struct TripleOf {
  std::array<FaceIndex, 3> faces;
  Quadruple quadruple;

  auto operator<=>(const TripleOf&) const = default;
};

/// Append the four triples of a quadruple with ascending faces.
template <class Quadruple>
void AddTriples(const FaceQuadruple& faces, Quadruple quadruple,
                std::vector<TripleOf<Quadruple>>& triples) {
  for (std::size_t left_out = 0; left_out < faces.size(); ++left_out) {
    TripleOf<Quadruple> triple = {{}, quadruple};
    for (std::size_t k = 0; k < 3; ++k) triple.faces[k] = faces[k < left_out ? k : k + 1];
    triples.push_back(triple);
  }
}

/// Sort triples and call visit(span<const TripleOf<Quadruple>>) for each run with equal faces.
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
