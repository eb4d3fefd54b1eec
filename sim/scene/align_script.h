#pragma once

#include <array>
#include <variant>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"

namespace regrasp::sim {

/// Return the contacts at `share` of the path between two waypoints.
/// Normals turn on the great circle.
[[nodiscard]] plan::FingerGrasp Interpolate(const plan::FingerGrasp& from,
                                            const plan::FingerGrasp& to, double share);

/// Path of a sliding step as one motion: t from 0 to end(), an integer at each waypoint.
class AlignPath {
 public:
  /// @param align  sliding step with at least one waypoint. Each waypoint has the fingers of the
  ///     first, in any order.
  explicit AlignPath(const plan::Align& align);

  [[nodiscard]] int end() const { return static_cast<int>(waypoints_.size()) - 1; }
  /// Return the grasp at t, with fingers in the order of the first waypoint.
  [[nodiscard]] plan::FingerGrasp At(double t) const;
  /// Return the total travel of the contacts from `from` to `to`; turns of normals do not count.
  [[nodiscard]] double Travel(double from, double to) const;
  /// Return whether the k-th contact is between the normals of two faces at t.
  [[nodiscard]] bool IsTurning(std::size_t k, double t) const;

 private:
  std::vector<plan::FingerGrasp> waypoints_;
};

/// Motion of fingers to other contacts by finger switches. Free fingers, the support fingers, make
/// contact. Then the fingers lift and reach their targets, and the support fingers break contact.
/// The k-th of them belongs to the k-th target.
struct FingerHandover {
  plan::FingerGrasp support_fingers;
  plan::FingerGrasp targets;
};

/// Sliding of fingers along the surface, one after the other, from one grasp to the next. All
/// grasps are between two waypoints, and their k-th contacts correspond. If only one contact
/// differs between consecutive grasps, the order of the fingers is fixed.
struct FingersSlide {
  std::vector<plan::FingerGrasp> grasps;
};

/// Simultaneous rolling of all fingers along the surface (sim/control/slide.h), between two
/// waypoints.
struct FingersRoll {
  plan::FingerGrasp from;
  plan::FingerGrasp to;
};

using AlignMove = std::variant<FingerHandover, FingersSlide, FingersRoll>;

/// Execution of a sliding step in the replay.
struct AlignScript {
  std::vector<AlignMove> moves;
  AlignShares shares;
};

/// Constraints of a script.
struct AlignLimits {
  double friction_angle = 0;       ///< friction angle, radians
  std::vector<FingerIndex> spare;  ///< fingers that are not in contact
  /// Preferred radius of a sphere that fits at every contact at which a finger stops
  /// (planner/criteria/reach.h), in the object's unit.
  double clearance = 0;
  /// Radius of that sphere if there is no script with `clearance`.
  double least_clearance = 0;
  /// Whether to prefer slides to handovers. Without free fingers only slides are possible.
  bool slide = false;
};

/// Divide the path of a sliding step, across its waypoints, into as few valid segments as possible.
/// In each segment the moving fingers are handed over, as many at once as there are free fingers.
///
/// A segment is as long as possible. Every grasp of the path between its ends is force closure (at
/// kSharesOfPath points between two waypoints), and so are the intermediate grasps during the
/// handovers, support fingers included. Fingers stop only with `clearance`: not in a concave
/// corner, nor on a normal that turns there. A segment that is also valid at kEasyFriction of the
/// friction is preferred, unless it is less than half as long; then about half of the segment is
/// used. Only if no segment is valid may fingers stop with `least_clearance`, then between two
/// normals too, and finally without clearance.
///
/// With `slide`, or without a free finger, fingers slide as far as possible, one after the other. A
/// segment of sliding satisfies these conditions:
/// - The other fingers alone, at their current contacts, have the quality kSlideQuality at
///   kSlideFriction of the friction.
/// - The fingertip has its clearance throughout.
/// - The segment stays between two waypoints, and does not skip a point at which the planned grasp
///   is not force closure.
/// - It is at least 1 / kSharesOfPath of the subpath.
///
/// If there is no such segment, fingers are handed over up to the next point at which there is one.
///
/// If no segment is valid, the fingers move to the next waypoint anyway. Without a free finger all
/// of them roll at once. Otherwise they slide, and the path is divided so that grasps between two
/// slides are force closure if possible.
[[nodiscard]] AlignScript WriteAlignScript(const object::Object& object, const plan::Align& align,
                                           const AlignLimits& limits);

inline constexpr int kSharesOfPath = 16;
inline constexpr double kSlideFriction = 0.85;  ///< share of μ available to the holding fingers
/// Required quality of the other fingers. The sliding finger's normal force is at least a hundredth
/// of the grasp force (kSlideForce), and its friction acts along the motion. Force and torque on
/// the object are thus at most √2 √(1 + μ²) times that. The other fingers can balance twice that in
/// every direction.
inline constexpr double kSlideQuality = 0.02;
/// Share of the path between two waypoints.
inline constexpr double kShortestAlignSegment = 1.0 / 256;
inline constexpr int kHopelessSegments = 8;  ///< number of segments if no number is valid
/// Shares of μ; the first valid one is used.
inline constexpr std::array kEasyFriction = {0.9, 0.97, 0.99};

}  // namespace regrasp::sim
