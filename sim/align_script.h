#pragma once

#include <array>
#include <variant>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp {

/// Fingers go over to other contacts: spare ones touch at the stand-ins, the fingers lift and come
/// down at their targets, the spare ones leave. The k-th stand-in is for the k-th target.
struct FingersGoOver {
  FingerGrasp stand_ins;
  FingerGrasp targets;
};

/// Fingers move along the surface, one after the other, from one grasp to the next; all of them lie
/// between two waypoints, and their k-th contacts belong together.
struct FingersSlide {
  std::vector<FingerGrasp> grasps;
};

using AlignMove = std::variant<FingersGoOver, FingersSlide>;

/// How the replay carries out an align.
struct AlignScript {
  std::vector<AlignMove> moves;
};

/// What a script has to keep to.
struct AlignLimits {
  double half_angle = 0;   ///< friction, radians
  std::vector<int> spare;  ///< fingers that hold nothing
  /// Wherever a finger comes to rest a ball of this radius should fit (planner/plan/clearance.h), the unit
  /// that of the object.
  double clearance = 0;
  /// Where there is no way with that, a ball of this one.
  double least_clearance = 0;
};

/// Cuts the whole way of an align, across its waypoints, into as few pieces as serve; in each the
/// moving fingers go over, as many at once as there are spare ones.
///
/// A piece is as long as it can be: every grasp on the way between its ends is force closure (at
/// kSharesOfWay places between two waypoints), and so are the mixtures that come up while the
/// fingers go over, stand-ins included. Fingers come to rest only where they can stand, with
/// `clearance`: not in a concave corner, nor on a normal that turns there. A piece that holds at
/// kEasyFriction of the friction too is preferred, unless it is less than half as long; then about
/// half of the piece serves. Only where no piece serves fingers rest with `least_clearance`, then
/// between two normals too, and at last where nothing fits.
///
/// Where no piece serves at all, or no finger is spare, the fingers slide to the next waypoint,
/// the way cut so that grasps between two slides are force closure where that is possible.
[[nodiscard]] AlignScript WriteAlignScript(const Object& object, const Align& align,
                                           const AlignLimits& limits);

inline constexpr int kSharesOfWay = 16;
inline constexpr double kShortestPiece = 1.0 / 256;  ///< of the way between two waypoints
inline constexpr int kHopelessPieces = 8;            ///< where no number of them serves
inline constexpr std::array kEasyFriction = {0.9, 0.97, 0.99};  ///< of μ, the first that serves

}  // namespace regrasp
