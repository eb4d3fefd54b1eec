#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "planner/base/deadline.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Visit pairs of triangles that meet outside their common vertices and edge, by exact predicates.
/// @param mesh  triangles without degenerate ones; any number of them may share an edge.
/// @param most_pairs  maximum number of tested pairs, those with overlapping boxes.
/// @param visit  receives a pair, the lower index first; returns whether to continue.
/// @returns false if there are more pairs than `most_pairs`, so that not all were tested.
/// @throws TimeUp  if the deadline is reached.
bool VisitCrossings(const TriangleMesh& mesh, std::size_t most_pairs, const Deadline& deadline,
                    const std::function<bool(TriangleIndex, TriangleIndex)>& visit);

/// Check that no two triangles meet outside their common vertices and edge.
/// @param mesh  a closed, consistently oriented 2-manifold without degenerate triangles.
/// @throws MeshError  kSelfIntersecting, with the names of two polygons; kTooLarge if more than
///     kMaxOverlaps pairs of boxes overlap.
/// @throws TimeUp  if the deadline is reached.
void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name,
                           const Deadline& deadline);

}  // namespace regrasp::object
