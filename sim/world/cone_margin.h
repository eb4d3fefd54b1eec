#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>

#include "sim/scene/measured.h"

namespace regrasp::sim {

/// The square of what of a force is friction; it is asked of every finger in every time step.
/// @param normal, twist  as in ConeMargin.
[[nodiscard]] inline double TangentialSquare(const Eigen::Vector3d& force,
                                             const Eigen::Vector3d& normal, double twist = 0) {
  return normal.cross(force).squaredNorm() + twist * twist;
}

/// What is left of the friction of a contact: the friction half-angle minus the angle between the
/// force on the object and the inward normal, radians. 0 where the force lies on its cone, negative
/// outside.
/// @param normal  unit.
/// @param twist   of a soft finger its torque about the normal over its torsion: it takes of the
///     same friction as a tangential force of this size at right angles to the one that there is.
/// @pre the force is not zero.
[[nodiscard]] double ConeMargin(const Eigen::Vector3d& force, const Eigen::Vector3d& normal,
                                double half_angle, double twist = 0);

/// Of several margins of a finger the smallest stays.
void AddMargin(FingerIndex finger, double margin, FingerMargins& margins);

/// The smallest of all.
[[nodiscard]] std::optional<double> SmallestMargin(const FingerMargins& margins);

/// The finger with the smallest, −1 for none.
[[nodiscard]] FingerIndex FingerOfSmallestMargin(const FingerMargins& margins);

/// Fingers that press with less than this, over the squeeze, have no margin: the angle of a force
/// that comes or goes says nothing, and what it can slip is nothing.
inline constexpr double kPressing = 1e-3;

/// A margin below this is a force that reached its cone, radians (0.03°): the engine keeps forces
/// inside to 1e-6, forces planned with a margin of a hundredth of the cone stay a tenth of a degree
/// off.
inline constexpr double kConeReached = 5e-4;

}  // namespace regrasp::sim
