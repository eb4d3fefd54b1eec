#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// CGAL's half-edge mesh, for its algorithms; only for .cc files, as it brings CGAL along.
using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// Some triangles of a mesh, which must form a 2-manifold; face i is `triangles[i]`.
[[nodiscard]] SurfaceMesh MakeSurfaceMesh(const TriangleMesh& mesh,
                                          const std::vector<std::array<int, 3>>& triangles);

/// What a surface's shells are of the solid.
struct SolidShells {
  /// Of each shell of the topology whether it is the wall of a cavity or in one: the outside does
  /// not see it.
  std::vector<bool> enclosed;
  std::string text;  ///< what became of several shells by a choice; otherwise empty
};

/// Checks that a surface bounds one solid, and orients it outward.
///
/// The shell with the largest volume is the outside; where it is oriented inward, the whole mesh is
/// turned. Every other shell must then be a cavity: oriented into the material, inside the outside
/// and inside no other cavity.
///
/// With Shells::kUnion solids may lie beside each other, each turned by itself, and in each other:
/// what is inside the union bounds nothing and is left out of mesh and topology.
///
/// Law: what is accepted without a choice is the same with it.
/// @param mesh  without self-intersection; turned in place, as is `topology`.
/// @throws MeshError  kEmpty where there is no volume, kSeveralSolids.
[[nodiscard]] SolidShells OrientSolid(TriangleMesh& mesh, SurfaceTopology& topology,
                                      std::optional<Shells> choice, const std::string& name);

}  // namespace regrasp::object
