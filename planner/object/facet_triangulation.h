#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/polygon_soup.h"
#include "planner/object/triangle_mesh.h"
#include "planner/object/weld.h"

namespace regrasp::object {

/// Largest distance of a flat polygon's corners from its plane, divided by the object diameter.
///
/// A file in metres with six decimals needs 1e-5 for an object of 5 cm. A polygon of the object's
/// width, bent by kCoplanarAngle, deviates by 2.5e-5.
inline constexpr double kPlanarTolerance = 2e-5;

/// Largest distance of a bent polygon's corners from its plane, divided by the object diameter.
///
/// A polygon beyond kPlanarTolerance is cut into triangles that are faces of their own; beyond
/// kBentTolerance it is rejected. The surface of a bent polygon depends on the cut: two cuts differ
/// by up to twice this distance, a tenth of the radius of a fingertip.
inline constexpr double kBentTolerance = 1e-3;

/// Return whether points lie exactly on one line. The first two must differ.
[[nodiscard]] bool AreCollinear(const std::vector<Eigen::Vector3d>& corners);

/// Triangulation of a polygon.
struct PolygonCut {
  /// Indices of corners, counter-clockwise from outside.
  std::vector<std::array<int, 3>> triangles;
  double off_plane = 0;  ///< largest distance of a corner from the polygon's plane
  /// Reason for the absence of triangles: kDegenerateFacet (no area) or kSelfIntersecting (the
  /// outline meets itself).
  std::optional<MeshDefect> defect = {};
};

/// Triangulate a polygon of three or more corners without new corners.
///
/// The polygon may be non-convex and bent. It is projected onto the coordinate plane that is
/// closest to parallel. A constrained Delaunay triangulation with exact predicates then cuts it.
[[nodiscard]] PolygonCut CutPolygon(const std::vector<Eigen::Vector3d>& corners);

/// Triangulate the polygons of a soup without new vertices.
///
/// Dropped polygons have no triangles. No triangle is degenerate.
/// @param diameter  diameter of the object, to which the tolerances are relative.
/// @throws MeshError  if a polygon has no area, is bent by more than kBentTolerance, or its outline
///     meets itself.
[[nodiscard]] TriangleMesh TriangulateFacets(const WeldedSoup& soup, double diameter,
                                             const std::string& name);

/// Thickness of a sliver divided by the diameter.
///
/// A thinner polygon joins the face across its longest edge. It lies on that face to a tenth of the
/// point tolerance, and the rounding of 32-bit files corrupts its normal.
inline constexpr double kSliverThickness = 1e-7;

/// Join adjacent coplanar polygons to planar faces.
///
/// Each face grows from the largest polygon without a face. A polygon joins across an edge of the
/// face if its normal is within kCoplanarAngle of two normals: that of its neighbour and that of
/// the first polygon. The second condition keeps a finely meshed curved surface from becoming one
/// face. Polygons of a filled surface join each other only; see PolygonSoup for the last parameter.
/// @returns face of each triangle, numbered from 0 in the order of the faces' first polygons.
[[nodiscard]] std::vector<FaceIndex> JoinCoplanarFacets(const TriangleMesh& mesh,
                                                        const SurfaceTopology& topology,
                                                        double diameter,
                                                        const std::vector<bool>& filled = {});

}  // namespace regrasp::object
