#pragma once

#include <span>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::certificate {

/// Check a proof in exact rational arithmetic, independently of floating-point force closure.
/// Contacts, friction and forces are the exact values of their doubles.
///
/// Forces that were computed or written as decimals never balance exactly. Therefore their residual
/// is removed exactly: the columns of a nonsingular part of the grasp matrix, found by elimination,
/// compensate for it. This changes their forces by about the size of the residual. The corrected
/// forces f must be strictly inside the cones: n·f > 0 and (n·f)² (1 + μ²) > |f|² |n|². If the
/// contacts are not collinear (in 2-D: not coincident), this implies force closure (Murray, Li and
/// Sastry 1994, Prop. 5.3).
///
/// A soft-finger contact has a torque about its normal as an additional unknown, inside the cone
/// together with its force (grasp::Contact). Then collinear contacts suffice if the normal of one
/// is not perpendicular to their line.
///
/// A twist other than 0 refutes force closure if the velocity u of every contact is in the polar
/// cone: n·u ≤ 0 and (n·u)² (1 + μ²) ≥ μ² |u|² |n|². If some u is not 0, forces inside the cones do
/// negative work, whereas balanced forces do none. If all u are 0, no force resists the twist. For
/// a soft-finger contact the spin e n·ω is included: (n·u)² (1 + μ²) ≥ μ² (|u|² |n|² + (e n·ω)²).
/// @param contacts   contacts whose normals have any length, because only their direction counts.
/// @param dimension  3, or 2 for planar contacts and forces.
/// @param mu  friction coefficient, positive.
[[nodiscard]] motion::ProofVerdict CheckGraspProof(std::span<const grasp::Contact> contacts,
                                                   int dimension, double mu,
                                                   const GraspProof& proof);

}  // namespace regrasp::certificate
