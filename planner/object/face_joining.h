#pragma once

#include <vector>

#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// A facet thinner than this times the diameter belongs to the face across its longest edge: it
/// lies within a tenth of the tolerance of points on that face, and the rounding of 32-bit files
/// leaves nothing of its normal.
inline constexpr double kSliverThickness = 1e-7;

/// Joins coplanar neighbouring facets, but none that was invented with one that was not.
///
/// Grown from the largest facet that has no face yet: a facet joins where it shares an edge with
/// the face, and its normal is within kCoplanarAngle both of its neighbour's and of the facet that
/// the face was grown from. The second keeps a finely curved surface from becoming one face.
/// @param invented  of each of the file's facets (PolygonSoup); empty where none is.
/// @returns for each triangle its face, faces counted from 0 in the order of their first facet.
[[nodiscard]] std::vector<FaceIndex> JoinCoplanarFacets(const TriangleMesh& mesh,
                                                        const SurfaceTopology& topology,
                                                        double diameter,
                                                        const std::vector<bool>& invented = {});

}  // namespace regrasp::object
