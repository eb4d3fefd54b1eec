#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "planner/base/deadline.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Tells `visit` of pairs of triangles that meet elsewhere than at the vertices and the edge that
/// they share, by exact predicates; of each the lower number first. It returns whether to go on.
/// @param mesh  triangles in any number about an edge, none of them degenerate.
/// @param most_pairs  of triangles with overlapping boxes, which are looked at.
/// @returns false where there are more, and not all pairs were looked at.
/// @throws TimeUp  the deadline came.
bool VisitCrossings(const TriangleMesh& mesh, std::size_t most_pairs, const Deadline& deadline,
                    const std::function<bool(TriangleIndex, TriangleIndex)>& visit);

/// Checks that no two triangles meet elsewhere than at the vertices and the edge that they share.
/// @param mesh  a closed, consistently oriented 2-manifold without degenerate triangles.
/// @throws MeshError  kSelfIntersecting, with two facets named; kTooLarge, more than kMaxOverlaps
///                    pairs would have to be looked at.
/// @throws TimeUp  the deadline came.
void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name,
                           const Deadline& deadline);

}  // namespace regrasp::object
