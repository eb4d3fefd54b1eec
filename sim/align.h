#pragma once

#include <optional>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/replay.h"
#include "sim/stage.h"

namespace regrasp {

/// Carries out an align, piece by piece, and says how.
///
/// Imitated: with a spare finger every finger goes over by switches. The spare one stands in at the
/// middle of the finger's way, the finger lifts and comes down at its target, the stand-in leaves;
/// so every finger ends where the plan wants it. A piece of the way is halved until every grasp in
/// between is force closure, at most into kMostPieces.
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

/// Whether every finger goes over with a stand-in for it, or by itself along the surface.
enum class GoOver { kByStandIn, kBySliding };

/// Cuts the way between two waypoints so that in each piece the fingers can go over one after the
/// other: every grasp in between is force closure, with a stand-in at the middle of each finger's
/// way where there are stand-ins.
/// @returns nullopt where that takes more than kMostPieces.
[[nodiscard]] std::optional<std::vector<AlignPiece>> CutAlign(const FingerGrasp& from,
                                                              const FingerGrasp& to,
                                                              const WrenchFrame& frame,
                                                              double half_angle, GoOver how);

inline constexpr int kMostPieces = 32;
inline constexpr int kHopelessPieces = 8;       ///< where no number of them serves
inline constexpr double kSlideFriction = 0.85;  ///< of μ, left to the fingers that hold
inline constexpr double kSlideForce = 0.01;  ///< least force of a sliding finger over the squeeze
inline constexpr double kSlideStep = 3e-5;   ///< of D in a time step

}  // namespace regrasp
