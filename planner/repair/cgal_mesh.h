#pragma once

#include "planner/object/polygon_soup.h"
#include "planner/object/solid.h"

namespace regrasp::repair {

using Kernel = object::SurfaceKernel;
using Mesh = object::SurfaceMesh;

/// Convert a surface of triangles to a CGAL mesh. For .cc files only.
/// @throws std::runtime_error  if more than two triangles share an edge, or two of them have the
///     same direction along it.
[[nodiscard]] Mesh MeshOf(const object::PolygonSoup& soup);

/// Return the triangles of a mesh, in its order.
[[nodiscard]] object::PolygonSoup SoupOf(const Mesh& mesh);

/// Split a mesh into its connected components, in the order of their first triangles.
[[nodiscard]] std::vector<Mesh> PartsOf(const Mesh& mesh);

/// Fill a hole with triangles.
/// @returns false if that is not possible. A long border fails if the Delaunay triangulation of its
///     vertices does not contain a filling, because a search of all triangles takes cubic time.
[[nodiscard]] bool FillHole(Mesh& mesh, Mesh::Halfedge_index border);

/// Return the enclosed volume of a mesh.
/// @pre `mesh` is closed.
[[nodiscard]] double VolumeOf(const Mesh& mesh);

/// Return true iff all vertices of `inner` are inside `outer`.
/// @pre `outer` is closed.
[[nodiscard]] bool IsInside(const Mesh& inner, const Mesh& outer);

}  // namespace regrasp::repair
