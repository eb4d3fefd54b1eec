#pragma once

#include <string>

#include "planner/base/deadline.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Checks with exact predicates that no two triangles meet elsewhere than at the vertices and the
/// edge that they share.
/// @param mesh  a closed, consistently oriented 2-manifold without degenerate triangles.
/// @throws MeshError  kSelfIntersecting, with two facets named.
/// @throws TimeUp  the deadline came; CGAL's part, about half of the work, is not interrupted.
void CheckSelfIntersection(const TriangleMesh& mesh, const std::string& name,
                           const Deadline& deadline);

}  // namespace regrasp::object
