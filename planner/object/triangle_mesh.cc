#include "planner/object/triangle_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "planner/base/number.h"
#include "planner/object/polygon_soup.h"

namespace regrasp::object {

Eigen::Vector3d DoubleAreaVector(const TriangleMesh& mesh, TriangleIndex triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

std::string VertexName(const TriangleMesh& mesh, int vertex) {
  const Eigen::Vector3d& p = mesh.vertices[vertex];
  return "vertex " + std::to_string(mesh.vertex_in_file[vertex]) + " (" + FormatShort(p.x()) +
         ", " + FormatShort(p.y()) + ", " + FormatShort(p.z()) + ")";
}

std::string FacetName(const TriangleMesh& mesh, TriangleIndex triangle) {
  return "facet " + std::to_string(mesh.facet_of_triangle[triangle]);
}

namespace {

[[noreturn]] void Reject(MeshDefect defect, const TriangleMesh& mesh, const std::string& name,
                         const EdgeSide& side, const std::string& what) {
  throw MeshError(defect, name + ": " + FacetName(mesh, TriangleIndex(side.facet)) + ": " + what +
                              " at the edge from " + VertexName(mesh, side.low) + " to " +
                              VertexName(mesh, side.high));
}

/// Check the number and orientation of the triangles at an edge.
/// @param sides  all sides of one edge.
void CheckEdge(const TriangleMesh& mesh, const std::string& name, std::span<const EdgeSide> sides) {
  if (sides.size() == 1) {
    Reject(MeshDefect::kNotClosed, mesh, name, sides[0], "not closed: no other facet");
  }
  if (sides.size() > 2) {
    Reject(MeshDefect::kNotManifold, mesh, name, sides[0],
           "not manifold: " + std::to_string(sides.size()) + " facets meet");
  }
  if (sides[0].forward == sides[1].forward) {
    Reject(MeshDefect::kNotOriented, mesh, name, sides[0],
           "not consistently oriented with " + FacetName(mesh, TriangleIndex(sides[1].facet)));
  }
}

std::vector<std::array<TriangleIndex, 3>> JoinTriangles(const TriangleMesh& mesh,
                                                        const std::string& name) {
  std::vector<std::array<TriangleIndex, 3>> neighbor(mesh.triangles.size());
  ForEachEdge(SortedEdgeSides(mesh.triangles, mesh.vertices.size()),
              [&](std::span<const EdgeSide> sides) {
                CheckEdge(mesh, name, sides);
                neighbor[sides[0].facet][sides[0].corner] = TriangleIndex(sides[1].facet);
                neighbor[sides[1].facet][sides[1].corner] = TriangleIndex(sides[0].facet);
              });
  return neighbor;
}

int CornerOf(const std::array<int, 3>& triangle, int vertex) {
  return static_cast<int>(std::ranges::find(triangle, vertex) - triangle.begin());
}

/// Check that the triangles at each vertex form one fan: rotating about the vertex must visit all
/// of them.
void CheckFans(const TriangleMesh& mesh, const std::vector<std::array<TriangleIndex, 3>>& neighbor,
               const std::string& name) {
  std::vector<TriangleIndex> triangle_at(mesh.vertices.size());
  std::vector<int> corners_at(mesh.vertices.size(), 0);
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    for (const int v : mesh.triangles[t]) {
      triangle_at[v] = t;
      ++corners_at[v];
    }
  }
  for (int v = 0; v < std::ssize(mesh.vertices); ++v) {
    int met = 0;
    TriangleIndex t = triangle_at[v];
    do {
      t = neighbor[t][CornerOf(mesh.triangles[t], v)];
      ++met;
    } while (t != triangle_at[v]);
    if (met == corners_at[v]) continue;
    throw MeshError(MeshDefect::kNotManifold, name + ": " + VertexName(mesh, v) +
                                                  ": not manifold: parts of the surface that "
                                                  "share no edge meet there (" +
                                                  FacetName(mesh, t) + " is one)");
  }
}

void FindShells(SurfaceTopology& topology) {
  topology.shell.assign(topology.neighbor.size(), -1);
  for (TriangleIndex seed{0}; seed < std::ssize(topology.shell); ++seed) {
    if (topology.shell[seed] >= 0) continue;
    std::vector<TriangleIndex> stack{seed};
    topology.shell[seed] = topology.shell_count;
    while (!stack.empty()) {
      const TriangleIndex t = stack.back();
      stack.pop_back();
      for (const TriangleIndex next : topology.neighbor[t]) {
        if (topology.shell[next] >= 0) continue;
        topology.shell[next] = topology.shell_count;
        stack.push_back(next);
      }
    }
    ++topology.shell_count;
  }
}

}  // namespace

SurfaceTopology ComputeTopology(const TriangleMesh& mesh, const std::string& name) {
  SurfaceTopology topology;
  topology.neighbor = JoinTriangles(mesh, name);
  CheckFans(mesh, topology.neighbor, name);
  FindShells(topology);
  return topology;
}

}  // namespace regrasp::object
