#pragma once

#include <Eigen/Core>

#include "planner/object/object.h"

namespace regrasp::object {

class Polyhedron;

/// What a fingertip that touches a patch feels of the surface: the unit mean, by area, of the
/// inward normals of the surface inside a ball about a point, as far as it is connected with the
/// point there. The far side of a wall does not count.
///
/// A friction cone about a facet's normal that is narrower by its angle to this one lies in the
/// cone about this one: a grasp that is force closure with the one is so with the other.
///
/// Laws: independent of rigid motion, of the unit of length and of how facets are cut; the face's
/// normal where the whole patch lies on the face.
/// @param face    that the point lies on.
/// @param radius  of the ball, the solid's unit of length, > 0.
[[nodiscard]] Eigen::Vector3d PatchNormal(const Polyhedron& solid, FaceIndex face,
                                          const Eigen::Vector3d& point, double radius);

}  // namespace regrasp::object
