#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "sim/ode/friction_box.h"

namespace regrasp {

/// A square plate on fixed balls, 3 or 4 in a circle, under gravity that tilts, or under a torque
/// about the vertical. Its critical friction is known: the tangent of the tilt, whatever the
/// direction, as all friction forces are then parallel; and the torque over weight times the
/// circle's radius.
///
/// Units are those in which the engines see a replay: the plate's size and mass are 1, the natural
/// time √(M D / weight) is 0.01, and a time step a fiftieth of that.
struct Plate {
  int points = 3;
  double mu = 0;
  double tilt = 0;     ///< radians
  double azimuth = 0;  ///< of the tilt
  double twist = 0;    ///< torque over weight times radius

  [[nodiscard]] double critical() const;
  [[nodiscard]] Eigen::Vector3d gravity(double share) const;
  [[nodiscard]] Eigen::Vector3d torque(double share) const;
  /// The centre of a ball that supports it.
  [[nodiscard]] Eigen::Vector3d ball(int point) const;
};

inline constexpr double kPlateHalf = 0.5, kPlateHalfThickness = 0.1;
inline constexpr double kPlateRadius = 0.35, kPlateBall = 0.05;
inline constexpr double kPlateTime = 0.01;
inline constexpr double kPlateStep = kPlateTime / 50;

/// What became of it once the load was whole: in plate sizes, and sizes in a natural time.
struct PlateMotion {
  double moved = 0;  ///< in ten natural times
  double creep = 0;  ///< largest speed in the last five
};

/// @param cone    "elliptic" or "pyramidal".
/// @param strict  with the settings of the replay, otherwise MuJoCo's defaults.
[[nodiscard]] PlateMotion MoveInMujoco(const Plate& plate, const std::string& cone, bool strict);

/// How friction is bounded at a contact, from the force of the last solution.
using BoxRule = std::function<sim::FrictionBox(const Eigen::Vector3d& normal,
                                               const Eigen::Vector3d& force, double mu)>;

/// @param solutions  of each step, at most: it is solved again until the cones are kept.
[[nodiscard]] PlateMotion MoveInOde(const Plate& plate, const BoxRule& rule, int solutions);

}  // namespace regrasp
