#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "bodies.h"

namespace regrasp_meshes {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The body's surface as a fine triangle mesh with vertices on it (restricted Delaunay; Boissonnat
/// and Oudot 2005).
Mesh FineMesh(const Body& body);

/// A coarse mesh of exactly `triangles` triangles as nearly equilateral and equal as they come:
/// isotropic remeshing (Botsch and Kobbelt 2004) with the edge length that gives a few more, the
/// shortest edges collapsed, then flips and relaxation along the surface. Its centre of mass is at
/// the origin.
/// @throws std::runtime_error  the mesh is not closed, cuts itself or has another number.
Mesh CoarseMesh(const Mesh& fine, const Field& field, std::size_t triangles);

/// The smallest angle of any triangle, radians.
double SmallestAngle(const Mesh& mesh);

}  // namespace regrasp_meshes
