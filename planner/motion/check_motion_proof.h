#pragma once

#include <numbers>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::motion {

/// Check in exact rational arithmetic that a grasp is force closure throughout a motion.
/// As in CheckGraspProof, but contacts move straight from `from` to `to`, and normals turn at a
/// constant rate on great circles.
///
/// The pieces must be consecutive from 0 to 1. On a piece forces are linear, f₀ to f₁, and may
/// leave a force r(t) and a torque τ(t) unbalanced by rounding, with Bernstein coefficients that
/// are known exactly. Three contacts that are never collinear (in the plane: two that never
/// coincide) can balance those at every instant, with forces of bounded length. Their forces must
/// have a larger margin than that inside the cones. The equations for the coefficients of balanced
/// forces, which are dependent if all contacts are in one plane, therefore need not be solved.
///
/// Soft fingers have torques about their normals, which are also linear in t and inside the cones
/// together with the forces (grasp::Contact). Two of them can replace the three contacts, because
/// the torque of one resists a turn about their line. A soft finger whose normal turns counts as a
/// hard-finger contact.
///
/// If a normal turns, f₀ and f₁ must both be inside the cones of the normals at both ends of the
/// piece. The directions within θ of a force are a convex part of the sphere for θ < π/2, so every
/// normal in between is within θ of it too. Normals between two faces are irrational. They are
/// represented by doubles, with cones narrower by kTurnedNormalBound, which covers the rounding.
[[nodiscard]] ProofVerdict CheckMotionProof(std::span<const grasp::Contact> from,
                                            std::span<const grasp::Contact> to, int dimension,
                                            double mu, std::span<const MotionSegment> pieces);

/// Check one piece, whose ends are anywhere in [0, 1].
[[nodiscard]] ProofVerdict CheckSegmentProof(std::span<const grasp::Contact> from,
                                             std::span<const grasp::Contact> to, int dimension,
                                             double mu, const MotionSegment& piece);

/// Largest turn of a normal, radians. Normals that turn farther, almost to the opposite, have no
/// well-defined great circle, and nothing is proved for them.
inline constexpr double kMostTurn = std::numbers::pi - 1e-3;

/// Bound on the rounding of turned normals, radians. The normal at t of a turn by α is the
/// direction of sin((1−t) α) n + sin(t α) n'. Up to kMostTurn its rounding is at most about 1e3
/// roundings of a double, 1e-12.
inline constexpr double kTurnedNormalBound = 1e-9;

}  // namespace regrasp::motion
