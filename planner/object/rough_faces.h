#pragma once

#include <optional>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/surface_topology.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {

/// Faces whose normal differs by more than the patch allows from the mean normal about them: the
/// sum of the area vectors of the facets that can be reached from the face without leaving a ball
/// of the patch's radius about its middle. A facet counts with no more than the patch's own area,
/// so that faces wider than the patch are never rough, and facets behind a thin wall do not count.
/// Laws: independent of rigid motion and of the unit of length.
/// @returns of each face whether it is.
[[nodiscard]] std::vector<bool> FindRoughFaces(const TriangleMesh& mesh,
                                               const SurfaceTopology& topology,
                                               const std::vector<FaceIndex>& face_of_triangle,
                                               const std::vector<Face>& faces, double radius,
                                               double most_angle);

}  // namespace regrasp::object
