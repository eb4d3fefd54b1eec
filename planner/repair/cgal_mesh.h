#pragma once

#include "planner/object/polygon_soup.h"
#include "planner/object/solid.h"

namespace regrasp::repair {

using Kernel = object::SurfaceKernel;
using Mesh = object::SurfaceMesh;

/// A surface of triangles as CGAL's mesh; only for .cc files.
/// @throws std::runtime_error  an edge has more than two of them, or they run along it the same
/// way.
[[nodiscard]] Mesh MeshOf(const object::PolygonSoup& soup);

/// The triangles of a mesh, in its order.
[[nodiscard]] object::PolygonSoup SoupOf(const Mesh& mesh);

/// The connected parts of a mesh, each a mesh of its own, in the order of their first facets.
[[nodiscard]] std::vector<Mesh> PartsOf(const Mesh& mesh);

/// Fills a hole with triangles.
/// @returns false where that cannot be done, also where its border is long and so tangled that the
/// Delaunay triangulation of its vertices does not hold triangles that fill it: to look at all
/// others takes the cube of its length.
[[nodiscard]] bool FillHole(Mesh& mesh, Mesh::Halfedge_index border);

/// @pre closed.
[[nodiscard]] double VolumeOf(const Mesh& mesh);

/// True iff all vertices of a mesh are inside another one.
/// @pre `outer` is closed.
[[nodiscard]] bool IsInside(const Mesh& inner, const Mesh& outer);

}  // namespace regrasp::repair
