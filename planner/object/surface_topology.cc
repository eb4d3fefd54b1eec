#include "planner/object/surface_topology.h"

#include <algorithm>
#include <tuple>

#include "planner/object/mesh_defect.h"

namespace regrasp::object {

namespace {

/// One side of an edge: the corner `corner` of `triangle` and the next, ends in order.
struct EdgeSide {
  int low, high;
  TriangleIndex triangle;
  int corner;
  bool forward;  ///< the triangle runs from low to high
};

std::vector<EdgeSide> SortedEdgeSides(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (TriangleIndex t{0}; t < std::ssize(mesh.triangles); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::ranges::sort(sides, {}, [](const EdgeSide& side) {
    return std::tuple(side.low, side.high, side.triangle);
  });
  return sides;
}

[[noreturn]] void Reject(MeshDefect defect, const TriangleMesh& mesh, const std::string& name,
                         const EdgeSide& side, const std::string& what) {
  throw MeshError(defect, name + ": " + FacetName(mesh, side.triangle) + ": " + what +
                              " at the edge from " + VertexName(mesh, side.low) + " to " +
                              VertexName(mesh, side.high));
}

/// `first` to `last`: all sides of one edge.
void CheckEdge(const TriangleMesh& mesh, const std::string& name, const EdgeSide* first,
               const EdgeSide* last) {
  const auto count = last - first;
  if (count == 1) {
    Reject(MeshDefect::kNotClosed, mesh, name, *first, "not closed: no other facet");
  }
  if (count > 2) {
    Reject(MeshDefect::kNotManifold, mesh, name, *first,
           "not manifold: " + std::to_string(count) + " facets meet");
  }
  if (first[0].forward == first[1].forward) {
    Reject(MeshDefect::kNotOriented, mesh, name, *first,
           "not consistently oriented with " + FacetName(mesh, first[1].triangle));
  }
}

std::vector<std::array<TriangleIndex, 3>> JoinTriangles(const TriangleMesh& mesh,
                                                        const std::string& name) {
  const std::vector<EdgeSide> sides = SortedEdgeSides(mesh);
  std::vector<std::array<TriangleIndex, 3>> neighbor(mesh.triangles.size());
  const EdgeSide* const end = sides.data() + sides.size();
  for (const EdgeSide *first = sides.data(), *last; first != end; first = last) {
    last = std::find_if(first, end, [&](const EdgeSide& side) {
      return side.low != first->low || side.high != first->high;
    });
    CheckEdge(mesh, name, first, last);
    neighbor[first[0].triangle][first[0].corner] = first[1].triangle;
    neighbor[first[1].triangle][first[1].corner] = first[0].triangle;
  }
  return neighbor;
}

int CornerOf(const std::array<int, 3>& triangle, int vertex) {
  return static_cast<int>(std::ranges::find(triangle, vertex) - triangle.begin());
}

/// Walking about a vertex from edge to edge must meet every triangle that has it.
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
