#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/mesh_defect.h"
#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// How far a polygon's corners may lie from its plane, relative to the object's diameter. Files
/// with six decimals of a 5 cm body in metres need 1e-5; a polygon as wide as the object that is
/// bent by kCoplanarAngle deviates by 2.5e-5.
inline constexpr double kPlanarTolerance = 2e-5;

/// A polygon that is bent by more is no longer flat, and is cut into triangles that are faces of
/// their own; beyond this, relative to the diameter, it is refused. A bent polygon is a surface
/// only up to how it is cut: two ways lie about twice this apart, a tenth of the radius of a
/// fingertip.
inline constexpr double kBentTolerance = 1e-3;

/// Whether points lie exactly on one line, the first two of which differ.
[[nodiscard]] bool AreCollinear(const std::vector<Eigen::Vector3d>& corners);

/// A polygon as triangles.
struct PolygonCut {
  std::vector<std::array<int, 3>> triangles;  ///< of its corners, counter-clockwise from outside
  double off_plane = 0;                       ///< of the corner that lies farthest from its plane
  /// Why there are no triangles: kDegenerateFacet, it has no area; kSelfIntersecting, its outline
  /// meets itself.
  std::optional<MeshDefect> defect = {};
};

/// Cuts a polygon of three or more corners into triangles without new corners.
///
/// It may be non-convex, and bent: it is cut as it is seen in the coordinate plane that it faces
/// most, by a constrained Delaunay triangulation with exact predicates.
[[nodiscard]] PolygonCut CutPolygon(const std::vector<Eigen::Vector3d>& corners);

/// Cuts the polygons of a soup into triangles without new vertices.
///
/// Those that are dropped have none. No triangle is degenerate.
/// @param diameter  the object's, which the tolerances are relative to.
/// @throws MeshError  a facet without area, a polygon that is bent by more than kBentTolerance or
///                    whose outline meets itself.
[[nodiscard]] TriangleMesh TriangulateFacets(const WeldedSoup& soup, double diameter,
                                             const std::string& name);

}  // namespace regrasp::object
