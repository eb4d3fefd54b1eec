#pragma once

#include <string>

#include "planner/object/surface_topology.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Checks that a surface bounds one solid, and orients it outward.
///
/// The shell with the largest volume is the outside; where it is oriented inward, the whole mesh is
/// turned. Every other shell must then be a cavity: oriented into the material, inside the outside
/// and inside no other cavity.
/// @param mesh  without self-intersection; turned in place, as is `topology`.
/// @returns the shell that is the outside.
/// @throws MeshError  kEmpty where there is no volume, kSeveralSolids.
[[nodiscard]] int OrientSolid(TriangleMesh& mesh, SurfaceTopology& topology,
                              const std::string& name);

}  // namespace regrasp::object
