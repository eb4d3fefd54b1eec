#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Friction that one finger of a grasp requires.
struct FingerFriction {
  /// Upper bound on the smallest friction angle of this finger alone at which the grasp is force
  /// closure, radians; all other fingers keep theirs. 0 if the grasp is force closure without it.
  double required = 0;
  bool needed = true;  ///< whether the grasp is not force closure without this finger
  /// Smallest friction angle of all other fingers at which the grasp is force closure without this
  /// finger, radians. nullopt if no angle below π/2 is enough.
  std::optional<double> without;
};

/// Measure, for each contact of a force-closure grasp, how far its friction alone may decrease.
///
/// Laws: `required` is at most the friction angle, and never increases when the friction angle
/// does; independent of rigid motion and of the unit of length.
/// @returns required friction per contact; empty if the grasp is not force closure at
/// `friction_angle`.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::vector<FingerFriction> MeasureFingerFriction(std::span<const Contact> contacts,
                                                                const object::WrenchFrame& frame,
                                                                double friction_angle);

/// Return the finger with the smallest friction margin of its own; −1 if there is none.
/// Among equal fingers, for example if no finger is necessary, it is the one without which the
/// other fingers require the largest friction angle; among those, the first one.
[[nodiscard]] int WeakestFinger(const std::vector<FingerFriction>& fingers);

/// Index of a finger in a grasp, and the friction that it requires.
struct WeakFinger {
  int finger = 0;
  FingerFriction friction;
};

/// Find the weakest finger only, the same as WeakestFinger of MeasureFingerFriction.
/// For the other fingers it computes only what a comparison with the weakest one requires.
/// @returns the weakest finger; nullopt if the grasp is not force closure.
/// @throws std::invalid_argument  as TestForceClosure.
[[nodiscard]] std::optional<WeakFinger> FindWeakestFinger(std::span<const Contact> contacts,
                                                          const object::WrenchFrame& frame,
                                                          double friction_angle);

}  // namespace regrasp::grasp
