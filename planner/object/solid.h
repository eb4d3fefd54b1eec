#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/object/object.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// CGAL's half-edge mesh, for CGAL's algorithms. Include this header only in .cc files, because it
/// includes CGAL.
using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// Make a mesh from some triangles, which must form a 2-manifold; face i is `triangles[i]`.
[[nodiscard]] SurfaceMesh MakeSurfaceMesh(const TriangleMesh& mesh,
                                          const std::vector<std::array<int, 3>>& triangles);

/// Relation of a surface's shells to the solid.
struct SolidShells {
  /// For each shell of the topology, whether it is the wall of a cavity or inside one, and thus
  /// invisible from outside.
  std::vector<bool> enclosed;
  std::string text;  ///< effect of the choice on several shells; otherwise empty
};

/// Check that a surface bounds one solid, and orient it outward.
///
/// The shell with the largest volume is the outer one. If it is oriented inward, the whole mesh is
/// reversed. Every other shell must then be a cavity: oriented into the material, inside the outer
/// shell and not inside another cavity.
///
/// With Shells::kUnion, solids may be next to or inside each other, and each is oriented by itself.
/// Shells inside the material of the union are removed from mesh and topology.
///
/// Law: a surface that is accepted without a choice is the same with one.
/// @param mesh  mesh without self-intersection; oriented in place, together with `topology`.
/// @throws MeshError  kEmpty if there is no volume; kSeveralSolids if a shell is not a cavity.
[[nodiscard]] SolidShells OrientSolid(TriangleMesh& mesh, SurfaceTopology& topology,
                                      std::optional<Shells> choice, const std::string& name);

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
