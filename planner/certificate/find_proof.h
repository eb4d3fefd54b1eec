#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/contact.h"
#include "planner/plan/contact_motion.h"

namespace regrasp {

/// A proof of force closure where there is one with slack, otherwise of the opposite; kNone for
/// grasps too close to the limit.
/// @param dimension   3, or 2 for planar contacts. @param half_angle  radians.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] GraspProof FindGraspProof(std::span<const Contact> contacts, int dimension,
                                        double half_angle);

/// Proofs for a whole motion, piece by piece from 0 to 1: forces of degree 1 that balance for all
/// t, to the first order in the piece's length of the largest margin at its middle; pieces are
/// halved down to kShortestPiece.
/// @returns nullopt where a normal turns, or where some piece has none.
[[nodiscard]] std::optional<std::vector<MotionPiece>> FindMotionProof(const GraspMotion& motion,
                                                                      int dimension,
                                                                      double half_angle);

/// Of a motion of length 1.
inline constexpr double kShortestPiece = 1.0 / 4096;

}  // namespace regrasp
