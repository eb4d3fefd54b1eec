#pragma once

#include <array>
#include <variant>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// The contacts `share` of the path between two waypoints; normals turn on the great circle.
[[nodiscard]] plan::FingerGrasp Interpolate(const plan::FingerGrasp& from,
                                            const plan::FingerGrasp& to, double share);

/// The path of an align as one motion: t from 0 to end(), a whole number at each waypoint.
class AlignPath {
 public:
  /// @param align  at least one waypoint; each has the fingers of the first, in any order.
  explicit AlignPath(const plan::Align& align);

  [[nodiscard]] int end() const { return static_cast<int>(waypoints_.size()) - 1; }
  /// Fingers in the order of the first waypoint.
  [[nodiscard]] plan::FingerGrasp At(double t) const;
  /// How far the contacts move from `from` to `to`, all added up; turns of normals add nothing.
  [[nodiscard]] double Travel(double from, double to) const;
  /// True iff the k-th contact is between the normals of two faces at t.
  [[nodiscard]] bool IsTurning(std::size_t k, double t) const;

 private:
  std::vector<plan::FingerGrasp> waypoints_;
};

/// Fingers move to other contacts by switches: spare ones, the support fingers, touch, the fingers
/// lift and come down at their targets, the support fingers leave. The k-th of them is for the k-th
/// target.
struct FingerHandover {
  plan::FingerGrasp support_fingers;
  plan::FingerGrasp targets;
};

/// Fingers move along the surface, one after the other, from one grasp to the next; all of them lie
/// between two waypoints, and their k-th contacts belong together. Where only one contact differs
/// from a grasp to the next the order of the fingers is settled.
struct FingersSlide {
  std::vector<plan::FingerGrasp> grasps;
};

/// All fingers roll along the surface together (sim/control/slide.h), between two waypoints.
struct FingersRoll {
  plan::FingerGrasp from;
  plan::FingerGrasp to;
};

using AlignMove = std::variant<FingerHandover, FingersSlide, FingersRoll>;

/// How the replay carries out an align.
struct AlignScript {
  std::vector<AlignMove> moves;
  AlignShares shares;
};

/// What a script has to keep to.
struct AlignLimits {
  double half_angle = 0;           ///< friction, radians
  std::vector<FingerIndex> spare;  ///< fingers that hold nothing
  /// Wherever a finger comes to rest a ball of this radius should fit
  /// (planner/criteria/reach.h), the unit that of the object.
  double clearance = 0;
  /// Where there is no script with that, a ball of this one.
  double least_clearance = 0;
  /// Slides are preferred to handovers. Without spare fingers they are all there is.
  bool slide = false;
};

/// Cuts the whole path of an align, across its waypoints, into as few segments as are valid; in
/// each the moving fingers are handed over, as many at once as there are spare ones.
///
/// A segment is as long as it can be: every grasp of the path between its ends is force closure (at
/// kSharesOfPath places between two waypoints), and so are the mixtures that come up during the
/// handovers, support fingers included. Fingers come to rest only where they can stand, with
/// `clearance`: not in a concave corner, nor on a normal that turns there. A segment that holds
/// at kEasyFriction of the friction too is preferred, unless it is less than half as long; then
/// about half of the segment is taken. Only where no segment is valid fingers rest with
/// `least_clearance`, then between two normals too, and at last where nothing fits.
///
/// With `slide`, or where no finger is spare, fingers slide as far as they can: one after the
/// other, each only while the others alone, as they stand then, have the quality kSlideQuality at
/// kSlideFriction of the friction; where the fingertip has its clearance all along; and no segment
/// leaves a subpath between two waypoints or leaps over a place where the planned grasp is not
/// force closure. A segment is at least a kSharesOfPath-th of the subpath; where there is none,
/// fingers are handed over up to the next place where there is one.
///
/// Where no segment is valid at all the fingers go to the next waypoint all the same: without a
/// spare finger all of them roll at once, otherwise they slide, the path cut so that grasps between
/// two slides are force closure where that is possible.
[[nodiscard]] AlignScript WriteAlignScript(const object::Object& object, const plan::Align& align,
                                           const AlignLimits& limits);

inline constexpr int kSharesOfPath = 16;
inline constexpr double kSlideFriction = 0.85;  ///< of μ, left to the fingers that hold
/// The sliding finger presses with a hundredth of the squeeze at least (kSlideForce), and friction
/// pulls along: force and torque on the object are at most √2 √(1 + μ²) of that. Twice it is what
/// the others can balance in every direction.
inline constexpr double kSlideQuality = 0.02;
inline constexpr double kShortestAlignSegment = 1.0 / 256;  ///< of the path between two waypoints
inline constexpr int kHopelessSegments = 8;                 ///< where no number of them is valid
inline constexpr std::array kEasyFriction = {0.9, 0.97, 0.99};  ///< of μ, the first that holds

}  // namespace regrasp::sim
