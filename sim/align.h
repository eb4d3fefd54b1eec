#pragma once

#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/replay.h"
#include "sim/stage.h"

namespace regrasp {

/// Carries out an align, piece by piece, and says how.
///
/// Imitated: with spare fingers every finger goes over by switches. A spare one stands in at the
/// middle of the finger's way, the finger lifts and comes down at its target, the stand-in leaves;
/// so every finger ends where the plan wants it. As many fingers go over at once as there are spare
/// ones. A piece of the way is halved until every grasp in between is force closure, down to
/// kShortestPiece.
///
/// Slid: without a spare finger, or where no piece is short enough. One finger after the other
/// moves along the surface; its force lies on its cone's edge, towards where it goes, as friction
/// wants it, and the others balance it inside cones of kSlideFriction μ. Where no such forces
/// exist either, the finger is dragged along with the best effort, and the judge decides. The way
/// is cut until the grasps between two slides are force closure.
///
/// A finger that only turns its normal at a border goes over in the same ways.
AlignMode PerformAlign(Stage& stage, const Align& align_B);

/// A piece of an align: every finger's contact before and after.
struct AlignPiece {
  FingerGrasp from;
  FingerGrasp to;
};

/// The contacts `share` of the way between two waypoints; normals turn on the great circle.
[[nodiscard]] FingerGrasp Interpolate(const FingerGrasp& from, const FingerGrasp& to, double share);

/// Cuts the way between two waypoints so that in each piece the fingers can go over, as many at
/// once as there are stand-ins: every grasp in between is force closure, stand-ins at the middle of
/// the fingers' ways included.
/// @param stand_ins  0 where the fingers slide, one after the other.
/// @returns nullopt where a piece of kShortestPiece does not serve.
[[nodiscard]] std::optional<std::vector<AlignPiece>> CutAlign(const FingerGrasp& from,
                                                              const FingerGrasp& to,
                                                              const WrenchFrame& frame,
                                                              double half_angle, int stand_ins);

inline constexpr double kShortestPiece = 1.0 / 256;  ///< of the way between two waypoints
inline constexpr int kHopelessPieces = 8;            ///< where no number of them serves
inline constexpr double kSlideFriction = 0.85;       ///< of μ, left to the fingers that hold
inline constexpr double kSlideForce = 0.01;  ///< least force of a sliding finger over the squeeze
inline constexpr double kSlideStep = 3e-5;   ///< of D in a time step

}  // namespace regrasp
