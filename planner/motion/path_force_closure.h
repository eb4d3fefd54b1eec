#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/motion/motion_segment.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::motion {

/// Length of the shortest intervals of the decision, for a motion of length 1.
inline constexpr double kShortestInterval = 1e-6;

/// Largest number of intervals of one motion. A motion that needs more is within about 1e-5 of the
/// limit.
inline constexpr int kMostIntervals = 20'000;

/// Largest number of shortest intervals that may stay undecided, a thousandth of the path. With
/// more the search ends, because the motion is too close to the limit.
inline constexpr int kMostUndecided = 1000;

/// Result of the decision of force closure along a motion.
struct PathForceClosure {
  /// kYes: proved throughout. kNo: an instant is not force closure. kTooClose: neither.
  grasp::Decision decision = grasp::Decision::kTooClose;
  /// Instant t of a negative decision (kNo), or the first undecided instant (kTooClose).
  double at = 0;
  /// Number of intervals no longer than kShortestInterval without a proof; their ends and centre
  /// are force closure.
  int undecided = 0;
  /// Whether, after kTooClose, the search stopped before the end of the motion.
  bool ended_early = false;
  /// Proofs found, in order; after kYes they cover the whole motion.
  MotionSegments pieces;

  /// Whether force closure is proved throughout.
  [[nodiscard]] bool holds() const { return decision == grasp::Decision::kYes; }
};

/// Decide force closure of a motion throughout the path, by bisection.
/// An interval is halved until one of three conditions is met:
/// - it has a proof (FindSegmentProof) that exact arithmetic accepts (CheckSegmentProof)
/// - an instant fails IsForceClosure
/// - it is shorter than kShortestInterval
///
/// The decision stops early after kMostIntervals intervals, or if the budget is exhausted.
///
/// Laws: monotone in friction_angle. A motion that is not force closure at some instant, however
/// short the interval, is never decided kYes.
[[nodiscard]] PathForceClosure DecidePathForceClosure(const GraspMotion& motion,
                                                      const object::WrenchFrame& frame,
                                                      double friction_angle, ProofBudget& budget);
/// Decide force closure of a motion with a default budget.
[[nodiscard]] PathForceClosure DecidePathForceClosure(const GraspMotion& motion,
                                                      const object::WrenchFrame& frame,
                                                      double friction_angle);

/// Accuracy of ComputePathRequiredFrictionAngle, radians (0.006°), if proofs succeed at it.
inline constexpr double kPathAngleAccuracy = 1e-4;

/// Compute bounds on the largest required friction angle along a motion.
/// `lower` is attained at an instant. `upper` is proved for the whole path, piece by piece, by
/// proofs that exact arithmetic accepts. `upper` is within kPathAngleAccuracy of `lower`, with two
/// exceptions. A narrow place of the path may require proofs with more slack, or the path may
/// require hundreds of pieces at that slack. If the budget is exhausted, `upper` is `proven`.
/// @param proven  friction angle at which the whole motion is known to be force closure, if any;
///     upper limit of `upper`.
/// @returns bounds; nullopt if an instant is force closure at no angle, or no angle below π/2 could
///     be proved for the whole path.
[[nodiscard]] std::optional<grasp::RequiredFrictionAngle> ComputePathRequiredFrictionAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven,
    ProofBudget& budget);
/// Compute the same bounds with a default budget.
[[nodiscard]] std::optional<grasp::RequiredFrictionAngle> ComputePathRequiredFrictionAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven);

}  // namespace regrasp::motion
