#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/polyhedron.h"
#include "planner/planning/spanning.h"

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

}  // namespace regrasp::polyhedron
