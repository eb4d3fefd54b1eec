#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/motion/motion_segment.h"

namespace regrasp::motion {

/// Motion of one contact from one waypoint of a sliding step to the next, t from 0 to 1.
/// The point moves straight and the normal turns on the great circle, both at constant rates.
class ContactMotion {
 public:
  /// @pre the normals are not opposite.
  ContactMotion(const grasp::Contact& from, const grasp::Contact& to);

  [[nodiscard]] grasp::Contact At(double t) const;
  [[nodiscard]] const grasp::Contact& from() const { return from_; }
  [[nodiscard]] const grasp::Contact& to() const { return to_; }
  /// Velocity dp/dt.
  [[nodiscard]] Eigen::Vector3d velocity() const { return to_.p - from_.p; }
  /// Angle by which the normal turns from t = 0 to 1, radians.
  [[nodiscard]] double turn() const { return turn_; }

 private:
  grasp::Contact from_;
  grasp::Contact to_;
  double turn_;
  Eigen::Vector3d turn_direction_;  ///< unit vector perpendicular to from_.n; zero if nothing turns
};

/// Motions of the contacts of a grasp between two waypoints.
using GraspMotion = std::vector<ContactMotion>;

[[nodiscard]] grasp::Grasp GraspAt(const GraspMotion& motion, double t);

/// Remaining work of searches for proofs along motions.
/// The unit is one contact of an evaluated piece, about 10 µs. Work is counted instead of timed, so
/// that the same input has the same result on every machine.
class ProofBudget {
 public:
  explicit ProofBudget(std::int64_t units) : left_(units) {}

  /// Consume the work of a piece.
  /// @returns false if the budget is exhausted.
  bool SpendPiece(std::size_t contacts) {
    if (left_ <= 0) return false;
    left_ -= static_cast<std::int64_t>(contacts);
    return true;
  }
  [[nodiscard]] std::int64_t left() const { return left_; }

 private:
  std::int64_t left_;
};

/// Length below which pieces are not halved, for a motion of length 1.
inline constexpr double kShortestProofPiece = 1.0 / 4096;

/// Search for a proof of force closure on a piece of a motion between two instants.
/// The proof consists of forces of degree 1 that balance at every instant and stay strictly inside
/// the cones (FindMovingForces).
///
/// While a normal turns, forces must be inside the cones of all its directions. The search uses the
/// largest circular cone inside those of both ends of the piece: about the direction halfway
/// between them, narrower by half of the turn. (A force inside both cones is inside all cones in
/// between. The reason is that the directions within θ of a force are a convex part of the sphere.)
/// A soft finger counts as a hard-finger contact while its normal turns. The search goes closer to
/// the limit than FindMotionProof (kLargestWeightNearLimit).
///
/// @param dimension   3, or 2 for planar contacts.
/// @param friction_angle  friction angle in radians, in (0, π/2).
/// @returns the proof; nullopt if none was found, which does not prove the opposite.
/// @throws std::invalid_argument  if friction_angle is out of range.
[[nodiscard]] std::optional<MotionSegment> FindSegmentProof(const GraspMotion& motion,
                                                            int dimension, double friction_angle,
                                                            double from, double to);

/// Search for proofs throughout a motion: consecutive pieces from 0 to 1 (FindSegmentProof).
/// A piece without a proof is halved; an instant without force closure ends the search. Such
/// instants are tested only if the whole motion is not proved in one piece, as most are.
///
/// Takes about 10 µs for four contacts in space if one piece is enough.
/// @param dimension   3, or 2 for planar contacts.
/// @param friction_angle  friction angle in radians, in (0, π/2).
/// @param shortest    length of the shortest pieces.
/// @returns the proofs; nullopt if none were found, which does not prove the opposite.
/// @throws std::invalid_argument  if friction_angle is out of range.
[[nodiscard]] std::optional<std::vector<MotionSegment>> FindMotionProof(
    const GraspMotion& motion, int dimension, double friction_angle,
    double shortest = kShortestProofPiece);

}  // namespace regrasp::motion
