#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Return the angle between two vectors, radians in [0, π], also accurate near 0 and π.
[[nodiscard]] inline double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Certified bounds on the required friction angle of a grasp, radians.
/// At `upper` the grasp is force closure; at and below `lower` it is not.
struct RequiredFrictionAngle {
  double lower = 0;
  double upper = 0;
};

/// Compute the smallest friction angle θ at which the contacts are force closure.
/// If angles closer to it are too close to call, the bounds are farther apart than `tolerance`, by
/// up to 1e-7 for all random grasps tested.
/// @param tolerance  largest distance between the bounds, radians, > 0.
/// @returns bounds; nullopt if no angle below π/2 is enough (to within 1e-6 rad).
/// @throws std::invalid_argument  as TestForceClosure, or if the tolerance is not > 0.
[[nodiscard]] std::optional<RequiredFrictionAngle> ComputeRequiredFrictionAngle(
    std::span<const Contact> contacts, const object::WrenchFrame& frame, double tolerance = 1e-9);

/// Compute the required friction angle within known bounds, radians.
/// @param known  bounds: the grasp is force closure at known.upper, and angles below known.lower
///     are irrelevant.
/// @throws std::invalid_argument  as ComputeRequiredFrictionAngle.
[[nodiscard]] RequiredFrictionAngle NarrowRequiredFrictionAngle(std::span<const Contact> contacts,
                                                                const object::WrenchFrame& frame,
                                                                const RequiredFrictionAngle& known,
                                                                double tolerance);

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
