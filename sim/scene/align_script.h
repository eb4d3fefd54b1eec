#pragma once

#include <array>
#include <variant>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// Fingers go over to other contacts: spare ones touch at the stand-ins, the fingers lift and come
/// down at their targets, the spare ones leave. The k-th stand-in is for the k-th target.
struct FingerHandover {
  FingerGrasp stand_ins;
  FingerGrasp targets;
};

/// Fingers move along the surface, one after the other, from one grasp to the next; all of them lie
/// between two waypoints, and their k-th contacts belong together. Where only one contact differs
/// from a grasp to the next the order of the fingers is settled.
struct FingersSlide {
  std::vector<FingerGrasp> grasps;
};

/// All fingers roll along the surface together (sim/control/roll.h), between two waypoints.
struct FingersRoll {
  FingerGrasp from;
  FingerGrasp to;
};

using AlignMove = std::variant<FingerHandover, FingersSlide, FingersRoll>;

/// Shares of the way of an align, all contacts' ways added up, by how it is carried out. They sum
/// to 1; for an align that only turns normals they are shares of the stretches between waypoints.
struct AlignShares {
  double imitated = 0;
  double slid = 0;         ///< while the other fingers alone hold the object
  double best_effort = 0;  ///< slid although they do not, or rolled: nothing else serves
};

/// How an align was carried out; kNone for other steps.
enum class AlignMode { kNone, kImitated, kSlid, kMixed };

/// How the replay carries out an align.
struct AlignScript {
  std::vector<AlignMove> moves;
  AlignShares shares;
};

/// What a script has to keep to.
struct AlignLimits {
  double half_angle = 0;   ///< friction, radians
  std::vector<int> spare;  ///< fingers that hold nothing
  /// Wherever a finger comes to rest a ball of this radius should fit
  /// (planner/criteria/clearance.h), the unit that of the object.
  double clearance = 0;
  /// Where there is no way with that, a ball of this one.
  double least_clearance = 0;
  /// Slides are preferred to going over. Without spare fingers they are all there is.
  bool slide = false;
};

/// Cuts the whole way of an align, across its waypoints, into as few pieces as serve; in each the
/// moving fingers go over, as many at once as there are spare ones.
///
/// A piece is as long as it can be: every grasp on the way between its ends is force closure (at
/// kSharesOfPath places between two waypoints), and so are the mixtures that come up while the
/// fingers go over, stand-ins included. Fingers come to rest only where they can stand, with
/// `clearance`: not in a concave corner, nor on a normal that turns there. A piece that holds at
/// kEasyFriction of the friction too is preferred, unless it is less than half as long; then about
/// half of the piece serves. Only where no piece serves fingers rest with `least_clearance`, then
/// between two normals too, and at last where nothing fits.
///
/// With `slide`, or where no finger is spare, fingers slide as far as they can: one after the
/// other, each only while the others alone, as they stand then, have the quality kSlideQuality at
/// kSlideFriction of the friction; where the fingertip has room all the way; and no piece leaves a
/// stretch between two waypoints or leaps over a place where the planned grasp is not force
/// closure. A piece is at least a kSharesOfPath-th of the stretch; where there is none, fingers go
/// over up to the next place where there is one.
///
/// Where no piece serves at all the fingers go to the next waypoint all the same: without a spare
/// finger all of them roll at once, otherwise they slide, the way cut so that grasps between two
/// slides are force closure where that is possible.
[[nodiscard]] AlignScript WriteAlignScript(const Object& object, const Align& align,
                                           const AlignLimits& limits);

inline constexpr int kSharesOfPath = 16;
inline constexpr double kSlideFriction = 0.85;  ///< of μ, left to the fingers that hold
/// The sliding finger presses with a hundredth of the squeeze at least (kSlideForce), and friction
/// pulls along: force and torque on the object are at most √2 √(1 + μ²) of that. Twice it is what
/// the others can balance in every direction.
inline constexpr double kSlideQuality = 0.02;
inline constexpr double kShortestAlignPiece = 1.0 / 256;  ///< of the way between two waypoints
inline constexpr int kHopelessPieces = 8;                 ///< where no number of them serves
inline constexpr std::array kEasyFriction = {0.9, 0.97, 0.99};  ///< of μ, the first that serves

}  // namespace regrasp
