#pragma once

#include <vector>

#include "planner/grasp/contact.h"

namespace regrasp::motion {

/// Motion of one contact from one waypoint of a sliding step to the next, t from 0 to 1.
/// The point moves straight and the normal turns on the great circle, both at constant rates.
class ContactMotion {
 public:
  /// @pre the normals are not opposite.
  ContactMotion(const grasp::Contact& from, const grasp::Contact& to);

  [[nodiscard]] grasp::Contact At(double t) const;
  [[nodiscard]] const grasp::Contact& from() const { return from_; }
  [[nodiscard]] const grasp::Contact& to() const { return to_; }
  /// Velocity dp/dt.
  [[nodiscard]] Eigen::Vector3d velocity() const { return to_.p - from_.p; }
  /// Angle by which the normal turns from t = 0 to 1, radians.
  [[nodiscard]] double turn() const { return turn_; }

 private:
  grasp::Contact from_;
  grasp::Contact to_;
  double turn_;
  Eigen::Vector3d turn_direction_;  ///< unit vector perpendicular to from_.n; zero if nothing turns
};

/// Motions of the contacts of a grasp between two waypoints.
using GraspMotion = std::vector<ContactMotion>;

[[nodiscard]] grasp::Grasp GraspAt(const GraspMotion& motion, double t);

}  // namespace regrasp::motion
