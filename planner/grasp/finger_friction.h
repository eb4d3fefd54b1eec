#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// What one finger of a grasp needs of its own friction.
struct FingerFriction {
  /// The smallest friction half-angle of this finger alone, all others keeping theirs, at which the
  /// grasp is force closure, radians, from above; 0 where the grasp is force closure without it.
  double required = 0;
  bool needed = true;  ///< the grasp is not force closure without this finger
  /// The smallest half-angle of all the others at which the grasp is force closure without this
  /// finger, radians; nullopt where none below π/2 is enough.
  std::optional<double> without;
};

/// For each contact of a force-closure grasp, how far the friction of that finger alone may fall.
///
/// Laws: `required` is at most the half-angle, and never grows when the half-angle does;
/// independent of rigid motion and of the unit of length.
/// @returns empty where the grasp is not force closure at `half_angle`.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::vector<FingerFriction> MeasureFingerFriction(std::span<const Contact> contacts,
                                                                const object::WrenchFrame& frame,
                                                                double half_angle);

/// The finger with the least of its own friction to spare; of equal ones, as where no finger is
/// needed, that without which the others need the largest half-angle; of those the first. −1 for
/// none.
[[nodiscard]] int WeakestFinger(const std::vector<FingerFriction>& fingers);

/// A finger of a grasp by its place in it, and what it needs.
struct WeakFinger {
  int finger = 0;
  FingerFriction friction;
};

/// The weakest finger alone, as WeakestFinger finds it of MeasureFingerFriction: of the others only
/// as much is found out as it takes to compare them.
/// @returns nullopt where the grasp is not force closure.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::optional<WeakFinger> FindWeakestFinger(std::span<const Contact> contacts,
                                                          const object::WrenchFrame& frame,
                                                          double half_angle);

}  // namespace regrasp::grasp
