#pragma once

#include <numbers>
#include <span>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::motion {

/// Checks in exact rational arithmetic, as CheckGraspProof, that a grasp is force closure all along
/// a motion: contacts move straight from `from` to `to`, and normals turn evenly on great circles.
///
/// The pieces must follow each other from 0 to 1. On a piece forces go linearly, f₀ to f₁, and may
/// leave a force r(t) and a torque τ(t) unbalanced by rounding, with Bernstein coefficients that
/// are known exactly. Three contacts that keep off one line (two in the plane that keep apart) can
/// take those up at every instant, with forces of bounded length: their forces must have more than
/// that to spare inside the cones. So the equations for the coefficients of balanced forces, which
/// are dependent where all contacts are in one plane, need not be solved.
///
/// Soft fingers have torques about their normals, linear in t as well, inside the cones with the
/// forces (grasp::Contact). Two of them can take the place of the three, as the torque of one
/// resists a turn about their line; one whose normal turns counts as a hard point.
///
/// Where a normal turns, f₀ and f₁ must both lie inside the cones of the normals at both ends of
/// the piece. The directions within θ of a force are a convex part of the sphere for θ < π/2, so
/// every normal between is within θ of it too. Normals between two faces are irrational: they are
/// taken as doubles, and their cones kTurnedNormalBound narrower, which covers the rounding.
[[nodiscard]] ProofVerdict CheckMotionProof(std::span<const grasp::Contact> from,
                                            std::span<const grasp::Contact> to, int dimension,
                                            double mu, std::span<const MotionSegment> pieces);

/// The same of one piece, whose ends are anywhere in [0, 1].
[[nodiscard]] ProofVerdict CheckSegmentProof(std::span<const grasp::Contact> from,
                                             std::span<const grasp::Contact> to, int dimension,
                                             double mu, const MotionSegment& piece);

/// Radians. Normals that turn farther, almost to the opposite, have no great circle to speak of:
/// nothing is proved of them.
inline constexpr double kMostTurn = std::numbers::pi - 1e-3;

/// Radians. The normal at t of a turn by α is the direction of sin((1−t) α) n + sin(t α) n'. Up to
/// kMostTurn its rounding is some 1e3 roundings of a double at most, 1e-12.
inline constexpr double kTurnedNormalBound = 1e-9;

}  // namespace regrasp::motion
