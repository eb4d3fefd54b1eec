#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "bodies.h"

namespace regrasp_meshes {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Compute a fine triangle mesh with vertices on the solid's surface (restricted Delaunay;
/// Boissonnat and Oudot 2005).
Mesh FineMesh(const Body& body);

/// Compute a coarse mesh of exactly `triangles` triangles that are as equilateral and equal as
/// possible.
/// The steps are isotropic remeshing (Botsch and Kobbelt 2004) with the edge length that gives
/// slightly more triangles, collapses of the shortest edges, then flips and relaxation along the
/// surface. The centre of mass is at the origin.
/// @throws std::runtime_error  if the mesh is not closed, intersects itself or has a different
///     number of triangles.
Mesh CoarseMesh(const Mesh& fine, const Field& field, std::size_t triangles);

/// Return the smallest angle of all triangles, radians.
double SmallestAngle(const Mesh& mesh);

}  // namespace regrasp_meshes
