#include "planner/gait/rolling.h"

#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

Eigen::Matrix3d BallIn(const kinematics::Finger& finger, const Posture& posture,
                       const Eigen::Isometry3d& pose) {
  return pose.linear().transpose() * kinematics::FramesOf(finger, posture).back().linear();
}

SurfacePoint Rolled(const SurfacePoint& contact, const Eigen::Matrix3d& turn, double radius,
                    const collision::BallContact& surface) {
  const Eigen::AngleAxisd by(turn);
  const Eigen::Vector3d to_centre = -radius * contact.n;
  const Eigen::Vector3d centre =
      contact.p + to_centre + by.angle() * by.axis().cross(to_centre);
  const auto near = surface.Find(centre, 2 * radius);
  if (near.empty()) return contact;
  return {near.front().point, -near.front().outward};
}

}  // namespace regrasp::gait
