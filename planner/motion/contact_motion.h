#pragma once

#include <vector>

#include "planner/grasp/contact.h"

namespace regrasp::motion {

/// The motion of one contact from one waypoint of an align to the next, t from 0 to 1: the point
/// moves straight, the normal turns on the great circle, both evenly.
class ContactMotion {
 public:
  /// The normals must not be opposite.
  ContactMotion(const grasp::Contact& from, const grasp::Contact& to);

  [[nodiscard]] grasp::Contact At(double t) const;
  [[nodiscard]] const grasp::Contact& from() const { return from_; }
  [[nodiscard]] const grasp::Contact& to() const { return to_; }
  /// dp/dt.
  [[nodiscard]] Eigen::Vector3d velocity() const { return to_.p - from_.p; }
  /// The angle by which the normal turns from t = 0 to 1, radians.
  [[nodiscard]] double turn() const { return turn_; }

 private:
  grasp::Contact from_;
  grasp::Contact to_;
  double turn_;
  Eigen::Vector3d turn_direction_;  ///< unit, perpendicular to from_.n; zero where nothing turns
};

/// The contacts of a grasp between two waypoints.
using GraspMotion = std::vector<ContactMotion>;

[[nodiscard]] grasp::Grasp GraspAt(const GraspMotion& motion, double t);

}  // namespace regrasp::motion
