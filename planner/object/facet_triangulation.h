#pragma once

#include <string>

#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// How far a polygon's corners may lie from its plane, relative to the object's diameter. Files
/// with six decimals of a 5 cm body in metres need 1e-5; a polygon as wide as the object that is
/// bent by kCoplanarAngle deviates by 2.5e-5.
inline constexpr double kPlanarTolerance = 2e-5;

/// Cuts the polygons of a soup into triangles without new vertices.
///
/// Polygons may be non-convex (a constrained Delaunay triangulation with exact predicates in the
/// coordinate plane that the polygon faces most). No triangle is degenerate.
/// @param diameter  the object's, which kPlanarTolerance is relative to.
/// @throws MeshError  a facet without area, a polygon that is not planar or whose outline meets
///                    itself.
[[nodiscard]] TriangleMesh TriangulateFacets(const WeldedSoup& soup, double diameter,
                                             const std::string& name);

}  // namespace regrasp::object
