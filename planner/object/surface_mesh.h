#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// CGAL's half-edge mesh, for its algorithms; only for .cc files, as it brings CGAL along.
using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// Some triangles of a mesh, which must form a 2-manifold; face i is `triangles[i]`.
[[nodiscard]] SurfaceMesh MakeSurfaceMesh(const TriangleMesh& mesh,
                                          const std::vector<std::array<int, 3>>& triangles);

}  // namespace regrasp::object
