#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/motion/contact_motion.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::motion {

/// Work that searches for proofs along motions may still do: pieces looked at, times their
/// contacts. Counted, not timed, so that the same input has the same answer on every machine; a
/// unit takes some ten microseconds.
class ProofBudget {
 public:
  explicit ProofBudget(std::int64_t units) : left_(units) {}

  /// @returns false where nothing is left.
  bool SpendPiece(std::size_t contacts) {
    if (left_ <= 0) return false;
    left_ -= static_cast<std::int64_t>(contacts);
    return true;
  }
  [[nodiscard]] std::int64_t left() const { return left_; }

 private:
  std::int64_t left_;
};

/// Of a motion of length 1: pieces are not halved below this.
inline constexpr double kShortestProofPiece = 1.0 / 4096;

/// Looks for a proof of force closure on the piece of a motion between two instants: forces of
/// degree 1 that balance at every instant and keep strictly inside the cones (FindMovingForces).
///
/// While a normal turns, forces must be inside the cones of all its directions. They are looked for
/// in the largest circular cone inside those of both ends of the piece: about the direction between
/// them, narrower by half of the turn. (A force inside both is inside all cones between, as the
/// directions within θ of a force are a convex part of the sphere.) A soft finger is taken to be a
/// hard point while its normal turns.
///
/// @param dimension   3, or 2 for planar contacts. @param half_angle  radians, in (0, π/2).
/// Looks closer to the limit than FindMotionProof does (kLargestWeightNearLimit).
/// @returns nullopt where none was found; that is no proof of the opposite.
/// @throws std::invalid_argument  half_angle out of range.
[[nodiscard]] std::optional<MotionSegment> FindSegmentProof(const GraspMotion& motion,
                                                            int dimension, double half_angle,
                                                            double from, double to);

/// Looks for proofs all along a motion: pieces from 0 to 1 that follow each other
/// (FindSegmentProof). A piece without a proof is halved; an instant that is not force closure ends
/// the search. Such instants are looked for only where the whole motion is not proved in one piece,
/// as most are.
///
/// Takes about 10 µs for four contacts in space where one piece is enough.
/// @param dimension   3, or 2 for planar contacts. @param half_angle  radians, in (0, π/2).
/// @param shortest    pieces shorter than this are not looked at.
/// @returns nullopt where none was found; that is no proof of the opposite.
/// @throws std::invalid_argument  half_angle out of range.
[[nodiscard]] std::optional<std::vector<MotionSegment>> FindMotionProof(
    const GraspMotion& motion, int dimension, double half_angle,
    double shortest = kShortestProofPiece);

}  // namespace regrasp::motion
