#pragma once

#include <vector>

#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

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
