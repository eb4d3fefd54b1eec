#pragma once

#include "planner/base/random.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp::polyhedron {

/// How far inside a part a point of its plane is; negative outside.
[[nodiscard]] double DepthIn(const FacePart& part, const Eigen::Vector2d& y);

/// The contact on a part that is best both inside the cone about its normal, half-angle of the
/// given tangent, that a focus point sees it in, and inside the part: by the smaller of the two
/// distances.
[[nodiscard]] Eigen::Vector3d ContactFor(const FacePart& part, double tangent,
                                         const Eigen::Vector3d& focus);

/// A random contact that the focus point sees; where draws find none on the part, the best one.
[[nodiscard]] Eigen::Vector3d DrawContact(const FacePart& part, double tangent,
                                          const Eigen::Vector3d& focus, RandomStream& random);

}  // namespace regrasp::polyhedron
