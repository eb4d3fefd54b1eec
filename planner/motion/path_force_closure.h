#pragma once

#include <optional>

#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/motion/contact_motion.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/motion/motion_segment.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::motion {

/// Force closure is decided down to intervals of this length, the motion being 1 long.
inline constexpr double kShortestInterval = 1e-6;

/// So many intervals of one motion are looked at: one that needs more keeps within about 1e-5 of
/// the limit.
inline constexpr int kMostIntervals = 20'000;

/// Where more than this many of the shortest intervals, a thousandth of the path, stay undecided
/// the search ends: the motion keeps too close to the limit.
inline constexpr int kMostUndecided = 1000;

/// What is known of force closure along a motion.
struct PathForceClosure {
  /// kYes: proved everywhere. kNo: an instant is not force closure. kTooClose: neither.
  grasp::Decision decision = grasp::Decision::kTooClose;
  /// After kNo the instant t that decided; after kTooClose the first one that nothing is known of.
  double at = 0;
  /// Intervals no longer than kShortestInterval without a proof, whose ends and centre are force
  /// closure.
  int undecided = 0;
  /// Of kTooClose: the search ended before it came to the end of the motion.
  bool ended_early = false;
  /// The proofs that were found, in order; after kYes they cover the whole motion.
  MotionSegments pieces;

  /// Proved everywhere.
  [[nodiscard]] bool holds() const { return decision == grasp::Decision::kYes; }
};

/// Decides force closure of a motion everywhere on the path, by bisection: an interval is halved
/// until it has a proof (FindSegmentProof) that exact arithmetic accepts (CheckSegmentProof), an
/// instant fails IsForceClosure, or it is shorter than kShortestInterval.
///
/// Ends early after kMostIntervals intervals, or where nothing is left of the budget.
///
/// Laws: monotone in half_angle; a motion that is not force closure at some instant, however short
/// the interval, is never said to hold.
[[nodiscard]] PathForceClosure DecidePathForceClosure(const GraspMotion& motion,
                                                      const object::WrenchFrame& frame,
                                                      double half_angle, ProofBudget& budget);
/// The same with a budget of its own.
[[nodiscard]] PathForceClosure DecidePathForceClosure(const GraspMotion& motion,
                                                      const object::WrenchFrame& frame,
                                                      double half_angle);

/// The accuracy of ComputePathRequiredHalfAngle, radians (0.006°), where proofs reach far enough at
/// it.
inline constexpr double kPathAngleAccuracy = 1e-4;

/// Bounds on the largest required half-angle along a motion: `lower` is attained at an instant,
/// `upper` is proved for the whole path, piece by piece, by proofs that exact arithmetic accepts.
/// `upper` is within kPathAngleAccuracy of `lower`, unless a narrow place of the path needs proofs
/// with more slack, or the path needs hundreds of pieces at that slack; then as far off as they
/// need. Where the budget ends it is `proven`.
/// @param proven  a half-angle at which the whole motion is known to be force closure, if any:
///                `upper` is never above it.
/// @returns nullopt where an instant is force closure at no angle, or no angle below π/2 could be
///          proved for the whole path.
[[nodiscard]] std::optional<grasp::RequiredHalfAngle> ComputePathRequiredHalfAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven,
    ProofBudget& budget);
/// The same with a budget of its own.
[[nodiscard]] std::optional<grasp::RequiredHalfAngle> ComputePathRequiredHalfAngle(
    const GraspMotion& motion, const object::WrenchFrame& frame, std::optional<double> proven);

}  // namespace regrasp::motion
