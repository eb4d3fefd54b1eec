#pragma once

#include <span>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/contact.h"

namespace regrasp::certificate {

/// A proof of force closure where there is one with slack, otherwise of the opposite; kNone for
/// grasps too close to the limit.
/// @param dimension   3, or 2 for planar contacts. @param half_angle  radians.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] GraspProof FindGraspProof(std::span<const grasp::Contact> contacts, int dimension,
                                        double half_angle);

}  // namespace regrasp::certificate
