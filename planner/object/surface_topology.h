#pragma once

#include <array>
#include <string>
#include <vector>

#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Which triangles are neighbours on a closed, consistently oriented 2-manifold.
struct SurfaceTopology {
  /// neighbor[t][k]: the triangle across the edge from corner k to corner k + 1 of triangle t.
  std::vector<std::array<TriangleIndex, 3>> neighbor;
  std::vector<int> shell;  ///< of each triangle: connected part of the surface, counted from 0
  int shell_count = 0;
};

/// Joins triangles at their edges and checks that each edge has two, running along it in opposite
/// directions, and that the triangles about each vertex are one fan.
/// @throws MeshError  kNotClosed, kNotManifold or kNotOriented, with facets and vertices named.
[[nodiscard]] SurfaceTopology ComputeTopology(const TriangleMesh& mesh, const std::string& name);

}  // namespace regrasp::object
