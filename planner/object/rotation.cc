#include "planner/object/rotation.h"

namespace regrasp::object {

// Eigen's templates for these three take seconds to compile in each file that uses them.

Eigen::AngleAxisd RotationInBody(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  return Eigen::AngleAxisd(from.transpose() * to);
}

Eigen::AngleAxisd RotationInWorld(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  return Eigen::AngleAxisd(to * from.transpose());
}

Eigen::Quaterniond AligningRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Eigen::Isometry3d PoseBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                              double share) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(from.linear())
                      .slerp(share, Eigen::Quaterniond(to.linear()))
                      .toRotationMatrix();
  pose.translation() = from.translation() + share * (to.translation() - from.translation());
  return pose;
}

}  // namespace regrasp::object
