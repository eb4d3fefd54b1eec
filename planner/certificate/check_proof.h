#pragma once

#include <span>

#include "planner/certificate/force_proof.h"
#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::certificate {

/// Checks a proof in exact rational arithmetic, every double taken at its value: contacts, friction
/// and forces. What decides force closure in floating point is not used.
///
/// Forces that were computed, or written as decimals, never balance exactly. The residual is
/// removed exactly: the columns of a nonsingular part of the grasp matrix, found by elimination,
/// take it up, which changes their forces by about as much as it was. What is tested is whether the
/// corrected forces f lie strictly inside the cones, n·f > 0 and (n·f)² (1 + μ²) > |f|² |n|². With
/// contacts that are not on one line (in the plane: not at one point) that is force closure
/// (Murray, Li and Sastry 1994, Prop. 5.3).
///
/// A soft finger has a torque about its normal as one more unknown, inside the cone with its force
/// (grasp::Contact), and contacts on one line will do where the normal of one is not at right
/// angles to it.
///
/// A twist other than 0 refutes where every contact's velocity u lies in the polar cone, n·u ≤ 0
/// and (n·u)² (1 + μ²) ≥ μ² |u|² |n|². Where some u is not 0, forces inside the cones do negative
/// work, and balanced ones do none; where all are 0, no force resists the twist. Of a soft finger
/// the spin e n·ω counts beside u: (n·u)² (1 + μ²) ≥ μ² (|u|² |n|² + (e n·ω)²).
/// @param contacts   normals need not be exactly unit: their direction counts.
/// @param dimension  3, or 2 for planar contacts and forces. @param mu  > 0.
[[nodiscard]] motion::ProofVerdict CheckGraspProof(std::span<const grasp::Contact> contacts,
                                                   int dimension, double mu,
                                                   const GraspProof& proof);

}  // namespace regrasp::certificate
